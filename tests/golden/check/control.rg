// Loops, features, conditions, techniques.
module control
feature fog: bool
feature path: { low, middle, high }
condition missed
const COUNT = 3
technique blur(image source, inout image target, const radius) {
  image half : rgba8 source / radius
  pass down : compute { read source as sampled  write half as storage }
  pass up : compute { read half as sampled  write target as storage }
}
graph g(surface s: rgba8 4x4) {
  image hdr : rgba8 64x64
  image out : rgba8 64x64 output
  for i in 0..COUNT {
    image pyramid[i] : r32f 64x64
    for j in 0..2 { buffer cell[i * 2 + j] : u32[4] output }
  }
  pass fill : compute {
    write hdr as storage
    write pyramid[0] as storage
    write c0 = cell[0] as storage  write c1 = cell[1] as storage  write c2 = cell[2] as storage
    write c3 = cell[3] as storage  write c4 = cell[4] as storage  write c5 = cell[5] as storage
  }
  for i in 1..COUNT {
    pass step[i] : compute { read source = pyramid[i - 1] as sampled  write target = pyramid[i] as storage  after fill }
  }
  pass show : compute { read pyramid[2] as sampled  write s as storage }
  when fog { use blur(hdr, out, 2) } else { use sharp = blur(hdr, out, 4) }
  when path == low { pass a : compute { read out as sampled  keep } } else { pass b : compute { read out as sampled  keep } }
  when not fog { pass c : compute { read out as sampled  keep } }
  if host missed {
    pass d : compute { write hdr as storage }
    pass e : compute { read hdr as sampled  keep  after show }
  }
}
