// Readers of an import on two queues, of which the one on the engine's reads in a stage that the engine does not wait for. The frame ends with a barrier,
// which stood on the queue of whichever reader came last.
module small
extent view = runtime(64, 32) max(128, 64)
interface Scene {
  maps: image rgba8 64x64 ready as sampled in compute after sampled in compute
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  image  made : rgba16f view
  image  kept : rgba16f view persistent init clear 0
  buffer sums : u32[64]
  pass make : compute { write made as storage }
  pass look : raster { read scene.maps as sampled in fragment  color kept clear 0 }
  pass sum  : compute queue compute { read scene.maps as sampled  read made as sampled  write sums as storage }
  pass show : raster { read sums as storage in fragment  color backbuffer clear 0 }
}
