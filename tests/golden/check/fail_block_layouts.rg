module layouts
struct Loose { a: f32[4] }  //~ note[RG0202]: `Loose` is declared here
graph g(surface s: rgba8 4x4) {
  buffer data : Loose[4]
  pass p : compute { write data as storage }  //~ note[RG0387]: used in a storage block here
  pass q : compute { params own: Loose  read data as storage  write s as storage }  //~ error[RG0386]: struct `Loose` is used in a uniform and in a storage block, which place `a` differently
}
