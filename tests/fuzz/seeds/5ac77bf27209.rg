graph g() { buf2[9 % 4] } high
feature shadowc: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph p"ics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queuer f view samples 4
  image flat : rgbŸÍ6f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no alias
  buffer lut : rgba4[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  cleauffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

  pass tone_mapÿÿÿ> : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass li counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memory(1920x10
