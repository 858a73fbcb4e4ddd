module unused
graph g(surface s: rgba8 4x4) {
  image spare : rgba8 4x4  //~ warning[RG0388]: `spare` is never used
  pass p : compute { write s as storage }
}
