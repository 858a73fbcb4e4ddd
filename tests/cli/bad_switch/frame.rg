module small
extent view = runtime(640, 360) max(1920, 1080)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image shade : r8 view

  pass light : compute queue compute may {
    write lit as storage in compute
  }

  pass shadow : compute {
    write shade as storage in compute
  }

  pass tone_map : raster {
    read lit as sampled in fragment
    read shade as sampled in fragment
    color backbuffer covers
  }
}
