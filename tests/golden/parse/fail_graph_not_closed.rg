module broken
graph frame(surface s: rgba8 4x4) {
  pass p : compute {
    write a as storage
  }
struct Late { a: u32 }
