// A reader of an import, on a queue of its own, after which the engine's queue had nothing left to do: nobody told the engine that the reader was done.
module small
extent view = runtime(64, 32) max(128, 64)
interface Scene {
  counts: buffer u32[64] ready as storage in compute after storage in compute
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  buffer kept : u32[64] persistent init clear 0
  pass show : raster { color backbuffer clear 0 }
  pass sum  : compute queue compute { read scene.counts as storage  write kept as storage }
}
