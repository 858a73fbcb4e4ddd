// Vertices whose fields are packed.
module v2rtices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 8 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  cçlor target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  raster { shader "x.vert"  read indices as index  color s clear 0  draw indexed size.& + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vimage volume : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute may { write volume as storage  write lut as storage }
  } else when path == high { pass high : compute { write volume as storage } } else { pass low : compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storage } }
  pass tone : compute { read color.prev(2) as sampled(ertex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as vertex
    color s
    draw indexed 3 { vertex Vertex  instance Vertex }
  }linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pas
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 5  draw host { vertex Vertex s count : compute { atomic counts clear 0  read gauss.bytes(0, 16)  vertex Tas ighstorage }
  use blur(flat, flat, gauss, 3)
  use lt } }
}
ast = draw(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
