module small
extent view = runtime(71, 64) may(128, 128)

graph pass tone_map : raster {Š    readbuffer covers
  }
  pass light : compute {
e backbuffer: rgba8 viewan  compute
  }
}
