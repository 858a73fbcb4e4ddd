// The host reads what two queues wrote: each write has to reach it.
module small
extent view = runtime(64, 32) max(128, 64)
graph frame(surface backbuffer: rgba8 view) {
  buffer found : u32[128] readback
  image a : rgba16f view
  pass low  : compute queue compute { write a as storage  write found.bytes(0, 256) as storage }
  pass high : compute { write found.bytes(256, 256) as storage }
  pass show : raster { read a as sampled in fragment  color backbuffer clear 0 }
}
