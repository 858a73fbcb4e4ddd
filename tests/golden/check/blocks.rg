// Blocks and what becomes of `fuse` in the checked program.
module blocks
extent volume = runtime(32, 24, 16) max(64, 64, 64)
feature merged : bool
struct Stretch { light: vec3  through: f32 }
technique chain(image density, inout image source) {
  pass fill : compute { block "fill.glsl"  read density as element  write source as element  dispatch over volume }
}
graph g() {
  image  density : r16f volume
  image  source  : rgba16f volume
  image  sums    : rgba16f volume output
  buffer lines   : u32[64] output
  fuse fog may unrounded when merged {
    pass inject : compute queue compute may { block "inject.glsl" group 4 4 4  write density as element  dispatch over volume }
    use chain(density, source)
    pass sum : compute { block "sum.glsl" group 8 8 1 scan z Stretch associative  read own = source as element  write sums as element  dispatch over volume }
  }
  pass walk : compute { block "walk.glsl" scan x u32  write line = lines as element  dispatch over 64 }
}
