module arena
extent view = runtime(128, 64) max(2048, 2048)
struct Light { position: vec2  radius: f32  strength: f32 }

interface World { lights: buffer Light[] ready as storage in compute }

graph frame(world: World, surface picture: rgba8 view after copy_src) {
  image glow  : r16f view
  image trail : r16f view history 1 init clear 0

  pass gather : compute { shader "gather.comp" group 8 8 1  read world.lights as storage  write glow as storage  dispatch over view }
  pass blend : compute { shader "blend.comp" group 8 8 1  read glow as sampled  read trail.prev(1) as sampled  write trail as storage  dispatch over view }
  pass show : raster { fullscreen "show.frag"  read trail as sampled  color picture }
}
