module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass light : compute {
    write lit as storage in compute
  }


  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
