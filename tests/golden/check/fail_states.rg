// States in which nobody can bring or take what is imported.
module states
interface Scene {
  a: image rgba8 4x4 ready as vertex  //~ error[RG0480]: the engine cannot bring or take `scene.a` as `vertex`: it is an image; those are `sampled`, `storage`, drawn to or copied
  b: buffer u32[4] ready as sampled in fragment  //~ error[RG0480]: the engine cannot bring or take `scene.b` as `sampled`: it is a buffer; those are `storage`, `uniform`, `vertex`, `index`, `indirect` or copied
  c: buffer rgba8[4] ready as uniform in fragment  //~ error[RG0480]: the engine cannot bring or take `scene.c` as `uniform`: it is a buffer of texels; those are `sampled`, `storage` or copied
  d: image d32f 4x4 ready as color  //~ error[RG0480]: the engine cannot bring or take `scene.d` as `color`: `d32f` is no format of colours; say `depth`
  e: image rgba8 4x4 ready as depth  //~ error[RG0480]: the engine cannot bring or take `scene.e` as `depth`: `rgba8` holds no depths; say `color`
  f: image d32f 4x4 ready as stencil  //~ error[RG0480]: the engine cannot bring or take `scene.f` as `stencil`: `d32f` has no stencil aspect
  g: image bc1 4x4 written as color  //~ error[RG0480]: the engine cannot bring or take `scene.g` as `color`: `bc1` is block-compressed: nobody draws to it
  h: image rgba8_srgb 4x4 written as storage in compute  //~ error[RG0480]: the engine cannot bring or take `scene.h` as `storage`: `rgba8_srgb` is none that images used as `storage` can have; say `sampled`
  i: image rgba8 4x4 written as sampled in fragment  //~ error[RG0480]: the engine cannot bring or take `scene.i` as `sampled`: that only reads; say `ready`, or how it was written
  j: buffer u32[4] ready as storage in transfer  //~ error[RG0480]: the engine cannot bring or take `scene.j` as `storage`: that does not happen in the stages after `in`
  k: buffer u32[4] ready as vertex in compute  //~ error[RG0480]: the engine cannot bring or take `scene.k` as `vertex`: that does not happen in the stages after `in`
  l: image rgba8 4x4 ready as sampled in fragment after index  //~ error[RG0480]: the engine cannot bring or take `scene.l` as `index`: it is an image; those are `sampled`, `storage`, drawn to or copied
  m: buffer u32[4] written as undefined  //~ error[RG0480]: the engine cannot bring or take `scene.m` as `undefined`: what was written was written somehow; leave the state out if the contents are worth nothing
  n: buffer u32[4] written as storage in compute after vertex
  o: image d32f_s8 4x4 ready as depth_readonly after copy_src
}
graph frame(scene: Scene, surface backbuffer: rgba8 4x4 after uniform) {  //~ error[RG0480]: the engine cannot bring or take `backbuffer` as `uniform`: it is an image; those are `sampled`, `storage`, drawn to or copied
}
