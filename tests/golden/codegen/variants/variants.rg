// Two graphs, one of them in two configurations, one with passes that a feature removes, that share a shader file behind different interfaces.
module variants

extent view = runtime(64, 32) max(256, 256)
feature bright: bool

graph first(surface backbuffer: rgba8 view after copy_src)
{
  image base : rgba16f view
  pass fill : compute {
    shader "fill.comp" group 8 8 1
    write  target = base as storage
    dispatch over view
  }
  when bright {
    pass glow : compute {
      shader "glow.comp" group 8 8 1
      update base as storage
      dispatch over view
    }
  } else {
    pass dim : compute {
      shader "glow.comp" group 8 8 1
      update base as storage
      dispatch over view
    }
  }
  pass show : raster {
    fullscreen "show.frag"
    read   base as sampled
    color  backbuffer
  }
}

graph second(surface backbuffer: rgba8 view after copy_src)
{
  image base : rg16f view
  pass fill : compute {
    shader "fill.comp" group 8 8 1
    write  target = base as storage
    dispatch over view
  }
  when bright {
    pass halo : compute {
      shader "halo.comp" group 8 8 1
      update base as storage
      dispatch over view
    }
  }
  pass show : raster {
    fullscreen "show.frag"
    read   base as sampled
    color  backbuffer
  }
}
