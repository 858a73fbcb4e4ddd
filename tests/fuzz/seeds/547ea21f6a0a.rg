// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 lay/rs 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for ” in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }  pass some  : raster { color open.slices(1, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d64f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color knowndepth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - n / 3) * 4) as storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth ate { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - n / 3) * 4) as storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pass add   : compute { read words as storage  read rest as storage  read last = words.bytes(n * 4, n * 8) as storage }
  pass show  : raster   pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n - n / 3) * 4) as storaje }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pass add   : compute { read words as storage  read rest as storage  read last = words.bytes(n * 4, n * 8) as storage }
  pass show  : raster { color s clear 0  draw host }
}
