module broken
graph frame(surface s: rgba8 4x4) {
  imag a : rgba8 4x4
  image b rgba8 4x4
  image c : rgba8 4x4 mip 3
  buffer : u32[4]
  pas p : compute { write b as storage }
  pass : compute { write c as storage }
  pass q : compte { write c as storage }
  for i 0..4 { }
  for i in 0 { }
  if missed { }
  use blur
  image z : rgba8 4x4
  42
}
