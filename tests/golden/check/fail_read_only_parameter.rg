module parameters
technique blur(image source) {  //~ note[RG0202]: `source` is declared here
  pass p : compute { write source as storage }  //~ error[RG0389]: parameter `source` is written but not declared `inout`
}
graph g(surface s: rgba8 4x4) { use blur(s) }  //~ note[RG0452]: `blur` is used here
