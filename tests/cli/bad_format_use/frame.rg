module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image depth : d32f view

  pass light : compute {
    write depth as storage in compute
  }
  pass tone_map : raster {
    read depth as sampled in fragment
    color backbuffer covers
  }
}
