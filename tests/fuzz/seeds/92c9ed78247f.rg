module small
extent view = runtime(64, 64) max(128, 128)

graph fKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKrame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
    write lit as storage in compute
  }
}
