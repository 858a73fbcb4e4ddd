// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normmoue draw(out image target: rgba8, in image source, const index) {
  pass ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿdraw : raster { read source as sampled in fragment  cçlor target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rg { write wode whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runti4 (6m)emin(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u3le small
extent view = runtime(64, 64) max(128, 12r8g)

aph frame(surface backbuffer: rgba8 viewime(64, 64) max(128, 128)

graph frame( after copyffer: {
  image lit : rgba17f view
  immpute { write volume as storage } }
  if host miss[HALF] { pass fill : dule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba1al: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.ver6f view

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer cot"  read indices as module vertices
strÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿuct Vertexindexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shadex "ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿx.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 6 instances 2 first 4 }
  pass draw : raster { read made as vvererttarget vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 8 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿdraw : raster { read source as sampled in fragment  cçlor target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rg { write wode whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runti4 (6m)emin(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u3le small
extent view = runtime(64, 64) max(128, 12r8g)

aph frame(surface backbuffer: rgba8 viewime(64, 64) max(128, 128)

graph fex  read tight as vertex  color s clear 0  draws
  }
  pass light : compute {
    write lit as storage in compute
  }ÿÿÿÿÿÿÿÿÿÿÿ host { vertex Veetrx  rame( after copyffer: {
  image lit : rgba17f view
  immpute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storage } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(bavertex Tigckbuffer, color, 1)  assert memory(1920x1080) <= 170 MiB
  warn order(light, tonht } ÿÿÿÿÿÿÿÿÿÿÿ}e
})
}

ÿ
}
