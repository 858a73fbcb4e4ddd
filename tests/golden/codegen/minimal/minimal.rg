// The least that makes a picture: one compute pass, one fullscreen pass.
module minimal

const TILE = 8
extent view = runtime(64, 32) max(256, 256)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image waves : rgba16f view

  pass make_waves : compute {
    shader "waves.comp" group TILE TILE 1
    write  waves as storage
    dispatch over view
  }
  pass show : raster {
    fullscreen "show.frag"
    read   waves as sampled
    color  backbuffer
  }
}
