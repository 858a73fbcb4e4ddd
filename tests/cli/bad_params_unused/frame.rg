module small
extent view = runtime(64, 64) max(128, 128)
struct View { exposure: f32 }

graph frame(params camera: View, surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass light : compute {
    shader "light.comp" group 8 8 1
    params camera
    write  lit as storage
    dispatch over view
  }
  pass tone_map : raster {
    read lit as sampled in fragment
    params camera
    color backbuffer covers
  }
}
