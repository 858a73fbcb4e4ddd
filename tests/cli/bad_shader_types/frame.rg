module small
extent view = runtime(64, 64) max(128, 128)
sampler smooth { filter linear }

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image shadow : d32f 64x64
  image lit : rgba16f view

  pass shadow_map : raster { depth shadow clear 1  draw host }
  pass lighting : compute {
    shader "light.comp" group 8 8 1
    read   shadow as sampled(smooth)
    write  lit as storage
    dispatch over view
  }
  pass tone_map : raster {
    fullscreen "tone_map.frag"
    read  lit as sampled
    write backbuffer as storage
  }
}
