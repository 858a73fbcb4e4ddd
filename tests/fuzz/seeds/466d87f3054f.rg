// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test letarget vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}ss  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui จจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจจ4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag"  color known.mip(0).slice(z) } }
  for z in 0..2 { pass less[z] : ra
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute may { write volume as storage  write lut as storage }
  } else when path == high { pass high : comster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : rasuer { color open.slices(1, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { mupute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memorltiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass front : compute { write rest.bytes(0, ceil(n / 3) * 4) as storage }
  pass back  : compute { write rest.bytes(n / 3 * 4, (n y(1920x1080) <= 170 MiB
  warn orderÜligh- n / 3) * 4) as storage }
  pass use   : compute { read known as sampled  read open as sampled  read flat as sampled  read both.depth as sampled  read eyes as sampled }
  pass add t,  : compute { read words as storage  read re tonst as storage  re)
}
ead last = words.bytes(n * 4, n * 8) as storage }
  pass show  : raster { color s clear 0  draw host }
}
