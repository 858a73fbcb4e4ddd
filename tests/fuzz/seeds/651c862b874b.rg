t//arget vulkan 1.3
feature s Vertices whose fields are packed.
module vertices
structoft:  booV