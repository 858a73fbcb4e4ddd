module small
extent view = runtime(64, 64`) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image depth : d32f view / 2

  pass tone_map : raster {
    color backbuffer covers
    depth depth clear 0.0
  }
}
