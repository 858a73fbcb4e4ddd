module blocks
extent view = runtime(64, 64) max(64, 64)
condition late
sampler linear { filter linear }
graph g(surface s: rgba8 view) {
  image  mid    : rgba16f view
  image  half   : rgba16f view / 2
  image  layers : rgba16f view layers 2
  image  deep   : rgba16f view samples 4
  buffer counts : u32[64]
  buffer many   : u32[view.area]
  pass p1 : raster { block "x.glsl"  color mid }
  pass p2 : compute { block "x.comp"  write mid as element  dispatch over view }
  pass p3 : compute { block "x.glsl" scan z f32  write mid as element  dispatch over view }
  pass p4 : compute { block "x.glsl" scan x f32[4]  write mid as element  dispatch over view }
  pass p5 : compute { block "x.glsl" group 8 8 scan x f32  write mid as element  dispatch over view }
  pass p6 : compute { block "x.glsl"  write mid as element  dispatch groups view }
  pass p7 : compute { block "x.glsl"  write many as element  dispatch over view }
  pass p8 : compute { shader "x.comp" group 8 8 1  write mid as element  dispatch over view }
  pass p9 : compute { block "x.glsl"  read half as element  write mid as element  dispatch over view }
  pass p10 : compute { block "x.glsl"  write layers as element  write mid as element  dispatch over view }
  pass p11 : compute { block "x.glsl"  write counts as element  write mid as element  dispatch over view }
  pass p12 : compute { block "x.glsl"  atomic many as element  write mid as element  dispatch over view }
  pass p13 : compute { block "x.glsl" "y.glsl"  write mid as element  dispatch over view }
  fuse outer {
    fuse inner {
      pass p14 : compute { block "x.glsl"  write mid as element  dispatch over view }
    }
  }
  fuse mixed {
    pass p15 : compute { block "x.glsl"  write mid as element  dispatch over view }
    pass p16 : compute { shader "y.comp" group 8 8 1  update mid as storage  dispatch over view }
    pass p17 : compute { block "x.glsl"  update mid as element  dispatch over view }
  }
  fuse one {
    pass p18 : compute { block "x.glsl"  write mid as element  dispatch over view }
  }
}
