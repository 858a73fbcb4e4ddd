module everything
import "one.rg"
target vulkan 1.3
const A = 1 + 2 * -3 / (4 - 5) % 6
extent view = runtime(1920, 1080) max(3840, 2160)
struct View { m: mat4  list: vec4[4] }
interface Scene { lights: buffer Light[] ready as storage in compute, fragment after storage  maps: image rgba8 16x16 layers 2 written as sampled }
sampler s { filter linear  mip nearest  address clamp  compare less  anisotropy 8 }
state opaque { cull back  front clockwise  depth test less  depth write off  bias 1.0 2.0  topology lines  alpha_to_coverage  stencil test equal  stencil reference 3
  stencil_front depth_fail increment_wrap  stencil_back write_mask 15 }
feature fog: bool
feature path: { low, high }
condition missed
allow RG0516
set materials 0 { uniform sampler2D albedo[16]; }
technique blur(image source, inout image target, const radius, params p: View, buffer weights) {
  pass go : compute { read source as sampled  write target as storage }
}
graph frame(params view_constants: View, scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image a : rgba8 view / 2 mips 3 layers 2 samples 1 history 1 init clear 0 no alias output allow RG0388
  image b[0] : r32f [4, 5, 6] 3d persistent
  buffer c : u32[ceil(view / 8).area] readback
  pass p : raster queue graphics may {
    shader "a.vert" "a.frag"
    state opaque
    params view_constants
    params own: View
    read renamed = a.mip(1).layer(0) as sampled(s) in fragment, vertex
    color b[0] clear (0, 0, 0, 1) blend add(one, zero) covers
    depth d readonly
    stencil d clear 1
    resolve b[0] -> e
    bind materials
    after q
    keep
    multiview
    allow RG0408
    draw indexed indirect c max 10 count c { per_draw Draw { id: u32 }  vertex Vertex }
  }
  pass q[1] : compute { shader "a.comp" group 8 8 1  atomic c as storage clear 0 disjoint  dispatch over view }
  pass t : transfer { copy a -> b[0]  blit a -> b[0] linear  clear a 0  fill c 7  update c  host { read a as copy_src  write b[0] as copy_dst } }
  pass h : host { read c as host }
  pass f : raster { fullscreen "f.frag"  color backbuffer  draw indexed 3 instances 2 first 1 offset 4 { vertex Vertex  instance Vertex } }
  for i in 0..mips(a) { pass l[i] : compute { write a.mip(i) as storage } }
  when fog { use blur(a, b[0], 3, view_constants, c) } else { use other = blur(a, b[0], 3, view_constants, c) }
  when not path == high { }
  if host missed { pass m : compute { } }
  fuse k may unrounded when not fog {
    pass k1 : compute { block "k.glsl" group 8 8 scan x View associative  read own = a as element  dispatch over view }
    pass k2 : compute { block "k.glsl" scan z f32  dispatch over view }
  }
  fuse j { pass j1 : compute { block "j.glsl" group TILE } }
  assert memory(1920x1080) <= 170 MiB
  warn order(p, q[1])
  allow RG0502
}
