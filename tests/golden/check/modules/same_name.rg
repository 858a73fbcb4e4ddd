module importing  //~ note[RG0202]: `importing` is declared here
target vulkan 1.0  //~ error[RG0009]: the targets are `vulkan 1.3` and `vulkan 1.4`, not 1.0
