module parts
extent view = runtime(64, 64) max(64, 64)
feature fog : bool
feature path : { low, high }
graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  pass light : compute {
    shader "light.comp" group 8 8 1
    features fog, path
    write  lit as storage
    dispatch over view
  }
  pass show : raster {
    fullscreen "show.frag"
    read  lit as sampled
    color backbuffer
  }
}
