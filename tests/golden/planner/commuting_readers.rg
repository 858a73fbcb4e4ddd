// Found by fuzzing, seed 500182: of writers that commute, one sees the fill by a wait already. That it reads it orders nothing for the others.
module wide
extent view = runtime(64, 32) max(128, 64)
feature rich: bool
interface Scene {
  maps: image rgba8 64x64 ready as sampled in fragment
}
technique halve(image source, inout image target) {
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  buffer found : u32[64] readback
  buffer scratch : u32[64]
  pass scratch_zero : transfer { fill scratch 0 }
  image p0 : rgba16f view history 2 init clear 0
  pass p0_step : compute { read was = p0.prev(1) as sampled  write p0 as storage }
  image s1 : d32f_s8 view
  pass s1_mark : raster { depth s1 clear 0.0  stencil s1 clear 0 }
  buffer s1_out : u32[64]
  pass s1_look : compute { read s = s1.stencil as sampled  write s1_out as storage }
  buffer a2 : u32[64]
  pass a2_fill : compute queue compute may { write a2 as storage }
  pass a2_go : compute queue compute { read args = a2 as indirect update scratch as storage }
  when rich { pass f0 : compute { update s1_out as storage } } else { pass g0 : transfer { fill s1_out 3 } }
  image k4 : rgba16f view
  image k4_to : rgba16f view
  pass k4_make : raster { color k4 clear (0, 1, 0, 1)  read ri = p0 as sampled in fragment }
  pass k4_copy : transfer queue transfer may { copy k4 -> k4_to }
  image k5 : rgba16f view
  image k5_to : rgba16f view
  pass k5_make : raster { color k5 clear (0, 1, 0, 1) }
  pass k5_copy : transfer queue compute may { copy k5 -> k5_to }
  buffer a6 : u32[64]
  pass a6_fill : transfer { fill a6 1 }
  pass a6_go : compute { read args = a6 as indirect  read ri = k4 as sampled in compute update scratch as storage }
  buffer a7 : u32[64]
  pass a7_fill : transfer { fill a7 1 }
  pass a7_go : compute { read args = a7 as indirect update scratch as storage }
  buffer o8 : u32[64] output
  pass o8_make : compute { write o8 as storage  read rb = a2 as uniform in compute }
  when rich { pass f1 : compute { update a6 as storage } } else { pass g1 : transfer queue compute may { fill a6 3 } }
  image m10 : rgba16f view samples 4
  image m10_flat : rgba16f view
  pass m10_draw : raster { color m10 clear 0  resolve m10 -> m10_flat  read rb = s1_out as storage in fragment }
  image p11 : rgba16f view history 2 init clear 0
  pass p11_step : compute { read was = p11.prev(1) as sampled  write p11 as storage }
  buffer h12 : u32[128]
  pass h12_zero : transfer queue transfer may { fill h12 0 }
  pass h12_0 : compute { update h12 as storage in compute disjoint   read rb = a6 as uniform in compute }
  pass h12_1 : raster { update h12 as storage in fragment disjoint color backbuffer clear 0 }
  pass h12_2 : compute { update h12 as storage in compute disjoint   read ri = k4_to as sampled in compute }
  pass resolve : compute {
    write found as storage
    read k4_to as sampled
    read k5 as sampled
    read k5_to as sampled
    read m10_flat as sampled
    read scratch as storage
    read a6 as storage
    read a7 as storage
    read h12 as storage
  }
  pass show : raster {
    color backbuffer clear 0
  }
}
