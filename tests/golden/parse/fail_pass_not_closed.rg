module broken
graph frame(surface s: rgba8 4x4) {
  pass p : compute {
    write a as storage
  pass q : compute {
    write b as storage
  }
}
