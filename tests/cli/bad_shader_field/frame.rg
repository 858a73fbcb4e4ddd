module small
extent view = runtime(64, 64) max(128, 128)
struct View { exposure: f32 }
struct Lamp { place: vec3  range: f32 }
interface Scene { lamps: buffer Lamp[] ready as storage in compute }

graph frame(params camera: View, scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass light : compute {
    shader "light.comp" group 8 8 1
    params camera
    read   scene.lamps as storage
    write  lit as storage
    dispatch over view
  }
  pass glow : compute {
    shader "glow.comp" group 8 8 1
    params camera
    update lit as storage
    dispatch over view
  }
  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
