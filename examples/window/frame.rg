module waves
extent view = runtime(320, 200) max(4096, 4096)
struct Clock { seconds: f32  aspect: f32 }

graph frame(params clock: Clock, surface window: bgra8 view) {
  image height : r16f view

  pass swell : compute { shader "swell.comp" group 8 8 1  params clock  write height as storage  dispatch over view }
  pass show : raster { fullscreen "show.frag"  read height as sampled  color window }
}
