module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer:b gra8 view af rtecopy_src)
{
  image lit : rgb1a16f view

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
    write lit as storage in #ompute
dddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddd  }ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ
}
