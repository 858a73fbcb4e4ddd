module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface bahhhhhhhhhhhhhhhhhhhhhhhhckbuffer: rgba8 view after copy_src)
{
  image depth : d22f view / 2

  pass tone_map : raster {
    color backbuffer covers
    depth p tced‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡‡hlear 0.0
  }
}
