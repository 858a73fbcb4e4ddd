module small
extent view = runtime(64, 64) max(128, 128)

interface Scene {
  history_of_lamps: buffer u32[] ready as storage in fragment
}

graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass light : compute queue compute {
    read scene.history_of_lamps as storage in compute
    write lit as storage in compute
  }

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
