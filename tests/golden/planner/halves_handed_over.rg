// An image whose mips are written on one queue and read on the other in one layout and two ranges: both halves of a transfer name the same range.
module small
extent view = runtime(64, 32) max(128, 64)
graph frame(surface backbuffer: rgba8 view) {
  image chain : rgba16f view mips 3
  pass first : compute queue compute { write chain.mip(0) as storage }
  for mip in 1..mips(chain) { pass down[mip] : compute queue compute { read source = chain.mip(mip - 1) as sampled  write target = chain.mip(mip) as storage } }
  pass top  : raster { read chain.mip(0) as sampled in fragment  color backbuffer clear 0 }
  pass rest : raster { read chain as sampled in fragment  color backbuffer blend add(one, one) }
}
