module small
extent view = runtime(64, 64) max(128, 128)
const TILE = 8
feature glow: bool
condition still
sampler soft { filter linear }
struct Camera { eye: vec4 }

graph frame(surface backbuffer: rgba8 view after copy_src, params camera: Camera)
{
  image lit   : rgba16f view
  image halo  : rgba16f view
  buffer sums : u32[4]

  pass light : compute { params camera  write lit as storage in compute  dispatch host }
  pass count : compute { write sums as storage in compute  dispatch host  keep }
  when glow {
    pass blur : compute { read lit as sampled(soft) in compute  write halo as storage in compute  dispatch host  keep }
  }
  pass show : raster { read lit as sampled(soft) in fragment  color backbuffer covers  draw host }
}
