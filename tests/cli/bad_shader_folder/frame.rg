module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image other : rgba16f view

  pass fill : compute {
    write other as storage in compute
  }
  pass light : compute {
    shader "light.comp" group 8 8 1
    read   other as sampled
    write  lit as storage
    dispatch over view
  }
  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
