// An import that is read as it comes, without a barrier, and then overwritten.
module small
extent view = runtime(64, 32) max(128, 64)
interface Scene {
  maps: image rgba8 64x64 ready as sampled in fragment
}
graph frame(scene: Scene, surface backbuffer: rgba8 view) {
  pass look : raster { read scene.maps as sampled in fragment  color backbuffer clear 0 }
  pass renew : raster { color scene.maps clear 0 }
}
