module glow
extent view = runtime(256, 128) max(4096, 4096)
struct Camera { sun: vec2  exposure: f32  bands: u32 }

graph frame(params camera: Camera) {
  image  hdr    : rgba16f view
  buffer pixels : u32[view.area] readback

  pass sky : compute { shader "sky.comp" group 8 8 1  params camera  write hdr as storage  dispatch over view }
  pass tone_map : compute { shader "tone_map.comp" group 8 8 1  params camera  read hdr as sampled  write pixels as storage  dispatch over view }
}
