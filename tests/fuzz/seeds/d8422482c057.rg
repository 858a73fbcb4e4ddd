// Vertices whose fields are packÿÿÿÿed.
module vertices
struct Vertex { at: vec3  normal:!rgb10a2  uv: rg16f  wei1hmodule small
extefer: rgba8 view ats: rgba8[2]  f