// An import that is read as it comes and in another way as well, and then updated: the update reads in the stage of the one reader what only the other
// had seen.
module small
extent view = runtime(64, 32) max(128, 64)
interface Scene {
  counts: buffer u32[64] ready as storage in fragment
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  buffer sums : u32[64]
  pass look  : raster { read scene.counts as storage in fragment  color backbuffer clear 0 }
  pass sum   : compute { read scene.counts as uniform  write sums as storage }
  pass renew : compute { update scene.counts as storage }
  pass show  : raster { read sums as storage in fragment  color backbuffer }
}
