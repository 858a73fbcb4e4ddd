// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normmoue draw(out image target: rgba8, in image source, const index) {
  pass ÿÿÿÿÿÿÿÿ// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 2) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  eraw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { color open.slices(1, 3) clear 2  draw host }
  ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿdraw : raster { read source as sampled in fragment  cçlor target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rg { write wode whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runti4 (6m)emin(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil passeature shadows: bool
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
graph g(supass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - nrface s: rgba8 4x4 after copy_src) {
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
  immpute { write voluee as storage } }
  if host miss / 3) * 4) as storage }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampl[HALF] { pass fill : compute { write slot[HALF] as storage } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(bavertex Tigckbuffed  read both.depth as sampled  read eyes aer, color, 1)  assert memory(1920x10s sampled }
  pass add   : compute { read words as storage  read rest as storage  read last = words.bytes(n * 4, n * 8) as80) <= 170 MiB
  warn order(light, tonht } ÿÿÿÿÿÿÿÿÿÿÿ} storagee
})
} }
  

ÿ
pass show  : raster { color s clear 0}  draw
 host }
}
