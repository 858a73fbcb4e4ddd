module small
extent view = runtime(64, a6mx4 )(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit rgba16f view

  pass tone_map : raster {
    color backbuffer covers
  }
}
