// A signal names a stage so that memory may change hands. A buffer that another queue releases needs no such name, though this queue wrote it.
module q
extent view = runtime(64, 32) max(128, 64)
feature rich: bool
interface Scene {
  table: buffer u32[64]  ready as storage in compute
}
technique halve(image source, inout image target) {
  image half : rgba16f source / 2
  pass down : compute { read source as sampled  write half as storage }
  pass up : compute { read half as sampled  update target as storage }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  buffer found : u32[64] readback
  image  s0    : d32f_s8 view
  pass s0_mark : raster { depth s0 clear 0.0  stencil s0 clear 0 }
  buffer s0_out : u32[64]
  pass s0_look : compute queue compute may { read s = s0.stencil as sampled  write s0_out as storage }
  image k1    : rgba16f view
  image k1_to : rgba16f view
  pass k1_make : raster { color k1 clear (0, 1, 0, 1)  read scene.table as storage in fragment }
  pass k1_copy : transfer queue compute may { copy k1 -> k1_to }
  buffer o2 : u32[64] output
  pass o2_make : compute queue compute may { write o2 as storage  read rb = s0_out as storage in compute  keep }
  use t0 = halve(k1_to, k1)
  when rich { pass f1: compute { update s0_out as storage } } else { pass g1: transfer queue compute may { fill s0_out 3 } }
  image s5 : d32f_s8 view
  pass s5_mark : raster { depth s5 clear 0.0  stencil s5 clear 0  read rb = s0_out as uniform in vertex, fragment }
  buffer s5_out : u32[64]
  pass s5_look : compute { read s = s5.stencil as sampled  write s5_out as storage }
  image k7    : rgba16f view
  image k7_to : rgba16f view
  pass k7_make : raster { color k7 clear (0, 1, 0, 1) }
  pass k7_copy : transfer { copy k7 -> k7_to }
  pass k7_blit : transfer { blit k7_to -> k7 linear }
  buffer b8 : u32[128]
  pass b8_low : compute queue compute may { write b8.bytes(0, 256) as storage  read ri = k1 as sampled in compute  read rb = s5_out as storage in compute }
  pass b8_high : compute queue compute may { write b8.bytes(256, 256) as storage }
  when rich { pass f2: compute queue compute may { update s0_out as storage } } else { pass g2: transfer queue compute may { fill s0_out 3 } }
  image s10 : d32f_s8 view
  pass s10_mark : raster { depth s10 clear 0.0  stencil s10 clear 0  read ri = k7 as sampled in vertex, fragment }
  buffer s10_out : u32[64]
  pass s10_look : compute { read s = s10.stencil as sampled  write s10_out as storage }
  image p11 : rgba16f view history 2 init clear 0
  pass p11_step : compute queue compute may { read was = p11.prev(1) as sampled  write p11 as storage  read rb = b8 as storage in compute }
  buffer h12 : u32[128]
  pass h12_zero : transfer queue compute may { fill h12 0 }
  pass h12_0 : compute { atomic h12 as storage in compute  read rb = s10_out as uniform in compute }
  pass h12_1 : raster { atomic h12 as storage in fragment color backbuffer clear 0 }
  pass resolve : compute {
    write  found as storage
    read   p11 as sampled
    read   s0_out as storage
    read   o2 as storage
    read   h12 as storage
  }
}
