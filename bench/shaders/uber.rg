// A shader of some 300 lines with eight features as plain `if`s: 256 variants. See bench/README.md.
module uber

import "features.rg"

extent view = runtime(640, 360) max(3840, 2160)

graph frame(params scene: SceneView, lamps: LampScene, surface backbuffer: rgba8 view after copy_src)
{
  image  albedo  : rgba8 view
  image  normal  : rg16 view
  image  surface : rgba8 view
  image  depth   : r32f view
  image  shadow  : d32f 1024x1024 layers 4
  image  haze    : rgba16f [64, 36, 32]
  image  lit     : rgba16f view
  buffer bins    : u32[256]

  pass fill : compute {
    write  albedo as storage
    write  normal as storage
    write  surface as storage
    write  depth as storage
    write  haze as storage
  }
  pass cast_shadow : raster {
    depth  shadow clear 1.0
  }
  pass shade : compute {
    shader "uber.comp" group 16 16 1
    features shadows, soft_shadows, haze_on, sky_light, translucency, sheen, rain, dither
    params scene
    read   lamps.lamps as storage
    read   albedo as sampled
    read   normal as sampled
    read   surface as sampled
    read   depth as sampled
    read   shadow as sampled(shadow_sampler)
    read   haze as sampled(linear_sampler)
    atomic bins as storage clear 0
    write  lit as storage
    dispatch over view
  }
  pass show : raster {
    read   lit as sampled in fragment
    read   bins as storage in fragment
    color  backbuffer covers
  }
}
