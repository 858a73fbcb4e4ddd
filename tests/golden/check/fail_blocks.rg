module blocks
extent view = runtime(64, 64) max(64, 64)
condition late
sampler linear { filter linear }
graph g(surface s: rgba8 view) {
  image  mid    : rgba16f view
  image  lower   : rgba16f view / 2
  image  layers : rgba16f view layers 2
  image  deep   : rgba16f view samples 4
  buffer counts : u32[64]
  buffer many   : u32[view.area]
  pass p1 : raster { block "x.glsl"  color mid }  //~ error[RG0721]: pass `p1` cannot be a block: it is no compute pass
  pass p2 : compute { block "x.comp"  write mid as element  dispatch over view }  //~ error[RG0722]: `x.comp` is no block: that is a piece of GLSL, a file called `.glsl`
  pass p3 : compute { block "x.glsl" scan z f32  write mid as element  dispatch over view }  //~ error[RG0721]: pass `p3` cannot be a block: it walks along z, an axis that its size does not have
  pass p4 : compute { block "x.glsl" scan x f32[4]  write mid as element  dispatch over view }  //~ error[RG0723]: `f32` cannot be carried along a line: that takes a number, a vector or a struct of up to 256 bytes
  pass p5 : compute { block "x.glsl" group 8 8 scan x f32  write mid as element  dispatch over view }  //~ error[RG0721]: pass `p5` cannot be a block: a group walks one element at a time along x unless `associative`
  pass p6 : compute { block "x.glsl"  write mid as element  dispatch groups view }  //~ error[RG0721]: pass `p6` cannot be a block: its elements are those of `dispatch over`
  pass p7 : compute { block "x.glsl"  write many as element  dispatch over view }  //~ error[RG0721]: pass `p7` cannot be a block: where its elements end is known from an image `as element`, or because the size is constant
  pass p8 : compute { shader "x.comp" group 8 8 1  write mid as element  dispatch over view }  //~ error[RG0724]: `mid` is accessed `as element`, but pass `p8` has no block
  pass p9 : compute { block "x.glsl"  read lower as element  write mid as element  dispatch over view }  //~ error[RG0725]: `lower` has no one element for each of pass `p9`: its size is [floor(view.x / 2), floor(view.y / 2)], that of the pass [view.x, view.y]
  pass p10 : compute { block "x.glsl"  write layers as element  write mid as element  dispatch over view }  //~ error[RG0725]: `layers` has no one element for each of pass `p10`: it has layers; name one
  pass p11 : compute { block "x.glsl"  write counts as element  write mid as element  dispatch over view }  //~ error[RG0725]: `counts` has no one element for each of pass `p11`: its size is 64, that of the pass [view.x, view.y]
  pass p12 : compute { block "x.glsl"  atomic many as element  write mid as element  dispatch over view }  //~ error[RG0336]: `atomic` does not go with role `element`
  pass p13 : compute { block "x.glsl" "y.glsl"  write mid as element  dispatch over view }  //~ error[RG0721]: pass `p13` cannot be a block: one file holds it
  fuse outer {  //~ note[RG0118]: the first is here
    fuse inner {  //~ error[RG0726]: `fuse inner` stands inside another `fuse`
      pass p14 : compute { block "x.glsl"  write mid as element  dispatch over view }
    }
  }
  fuse mixed {
    pass p15 : compute { block "x.glsl"  write mid as element  dispatch over view }
    pass p16 : compute { shader "y.comp" group 8 8 1  update mid as storage  dispatch over view }  //~ error[RG0727]: `fuse mixed` merges blocks, and pass `p16` has none; with `may` it would stay as it is
    pass p17 : compute { block "x.glsl"  update mid as element  dispatch over view }
  }
  fuse one {
    pass p18 : compute { block "x.glsl"  write mid as element  dispatch over view }
  }
}
