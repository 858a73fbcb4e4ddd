// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep =!runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference .  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  imagIe open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { color open.slmodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface ba28, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass tone_map : raster {
  ckbuffer: shown : u32[n] readback
  pass left  : compute { write part = words.bytes(0, n / 2 * 4) as storage }
  pass right : compute { write part = words.bytes(n / 1 * 4, 4) as storage }
  pass s  : compute { read words.bytes(0, n / 2 * 4) as storage  write shown a rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pasices(1, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw hos light : compute {
    write lit as storage in computest }
  fonown : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw  known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as samplÿÿÿed }
  pass add   : compute { read words as storage  read rest as storage  read lasÿÿ
t = words.bytes(n * 4, n * 8) as storage }
  pass show  : r}ast  write lit as storage in c8)

graph frameer { c
olor (surface backbuffer: ÿÿÿ>rgba8 view after copy_src)
{
  geaiackbuffer covers
  }
  pass ligs cleahr 0  draw t : compute {
    write lit as storage in compute
  }host }

}
}
