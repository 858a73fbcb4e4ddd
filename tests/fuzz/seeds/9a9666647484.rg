module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: pgba8 vw
  image unused : r8l
extent view = runtime(64, 64) max(128,if 128)

gcompute
  }

  pass tone_map : raster {
    jead lit as sampled in fragment
    color backbuffer covers
  }
}