// An output is observable at the end of the frame: what is written after it may not lie in its bytes.
module small
extent view = runtime(64, 32) max(128, 64)
graph frame(surface backbuffer: rgba8 view) {
  image q1 : rgba16f view
  pass q1_one : compute queue compute may { write q1 as storage }
  image q6 : rgba16f view
  pass q6_one : compute queue compute may { write q6 as storage }
  buffer o8 : u32[64] output
  pass o8_make : compute { write o8 as storage }
  buffer a9 : u32[64]
  pass a9_fill : transfer { fill a9 1 }
  image c11 : rgba16f view mips 6
  pass c11_first : compute queue compute may { write c11.mip(0) as storage  read ri = q6 as sampled in compute  read rb = a9 as storage in compute }
  for mip in 1..mips(c11) { pass c11_down[mip] : compute queue compute may { read source = c11.mip(mip - 1) as sampled  write target = c11.mip(mip) as storage } }
  pass c11_use : raster { read c11 as sampled in fragment  color backbuffer clear 0 }
}
