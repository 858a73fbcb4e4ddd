module work
struct Big { m: mat4[3] }
struct Pair { a: u32  b: u32 }
state opaque { cull back }
graph g(surface s: rgba8 4x4) {
  buffer pairs : Pair[4]
  pass p1 : compute { shader "x.glsl"  write s as storage  dispatch over 4 }  //~ error[RG0366]: `x.glsl` does not end in .vert, .tesc, .tese, .geom, .frag or .comp
  pass p2 : compute { shader "x.frag"  write s as storage  dispatch over 4 }  //~ error[RG0367]: `x.frag` is of a stage that a compute pass does not have
  pass p3 : compute { shader "x.comp" "y.comp" group 8 8 1  write s as storage  dispatch over 4 }  //~ error[RG0368]: `y.comp` is a second shader of its stage
//~^ note[RG0118]: the first is here
  pass p4 : compute { shader "../x.comp" group 8 8 1  write s as storage  dispatch over 4 }  //~ error[RG0369]: `../x.comp` is outside the folder of the root file
  pass p5 : raster { fullscreen "x.vert"  color s }  //~ error[RG0370]: `fullscreen` takes one fragment shader and no other
  pass p6 : raster { shader "x.vert" "x.frag" group 8 8 1  color s clear 0  draw 3 }  //~ error[RG0371]: only compute passes have a group size
  pass p7 : compute { shader "x.comp" group 64 64 1  write s as storage  dispatch over 4 }  //~ error[RG0372]: a group of 4096 invocations is over the limit of 1024
  pass p8 : compute { shader "x.comp" group 8 8 1  write s as storage  dispatch over 0 }  //~ error[RG0373]: a dispatch over 0 does nothing
  pass p9 : raster { color s clear 0  dispatch over 4 }  //~ error[RG0374]: `dispatch` belongs in a compute pass
  pass p10 : compute { write s as storage  draw 3 }  //~ error[RG0375]: `draw` belongs in a raster pass
  pass p11 : compute { write s as storage  state opaque }  //~ error[RG0376]: `state` belongs in a raster pass
  pass p12 : raster { shader "x.vert"  color s clear 0  draw 3  draw 4 }  //~ error[RG0377]: the pass already has a `draw`
  pass p13 : compute { shader "x.comp" group 8 8 1  write s as storage }  //~ error[RG0378]: pass `p13` names a shader but dispatches nothing
  pass p14 : compute { write s as storage  dispatch over 4 }  //~ error[RG0379]: pass `p14` dispatches but names no shader; say `dispatch host` if the host records it
  pass p15 : raster { shader "x.vert"  color s clear 0 }  //~ error[RG0380]: pass `p15` names shaders but draws nothing
  pass p16 : raster { color s clear 0  draw 3 }  //~ error[RG0381]: pass `p16` draws but names no shader; say `draw host` if the host records it
  pass p17 : raster { shader "x.frag"  color s clear 0  draw 3 }  //~ error[RG0382]: pass `p17` has no vertex shader
  pass p18 : raster { shader "x.vert"  color s clear 0  draw indirect pairs max 4 }  //~ error[RG0383]: the elements of `pairs` are 8 bytes; indirect arguments take 16
  pass p19 : raster { color s clear 0  draw host { per_draw Big } }  //~ error[RG0384]: struct `Big` is 192 bytes; push constants have 128
  pass p20 : raster queue compute { color s clear 0 }  //~ error[RG0385]: raster pass `p20` cannot run on a compute queue
  pass p21 : compute { shader "x.comp" group 0 1 1  write s as storage  dispatch over 4 }  //~ error[RG0218]: 0 is not between 1 and 1024
  pass p22 : compute { shader "x.comp"  write s as storage  dispatch over 4 }  //~ error[RG0258]: compute shader `x.comp` has no group size; write `group X Y Z` behind it
  pass p23 : compute { shader "x.comp" group 8 8 1  write s as storage  dispatch groups 4294967297 }  //~ error[RG0259]: pass `p23` dispatches 4294967297 groups along an axis, and 65535 are the most that a command takes
  pass p24 : raster { color s clear 0  shader "x.vert"  draw 4294967299 }  //~ error[RG0259]: pass `p24` draws 4294967299 vertices, and 4294967295 are the most that a command takes
}
