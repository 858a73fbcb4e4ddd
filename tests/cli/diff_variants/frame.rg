module small
extent view = runtime(1024, 1024) max(2048, 2048)
feature fog: bool

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass light : compute { write lit as storage in compute }
  when fog {
    image air : rgba16f view
    pass fill : compute { write air as storage in compute }
    pass blend : compute {
    read air as sampled
    write lit as storage in compute
    }
  }
  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
