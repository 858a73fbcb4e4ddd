target vulkan 1.3
feature soft: bo
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  colorextent n = runtime(64) min(2) max(1000)
graph frame() {
  buffer words : u32[n]
  buffer shown : u32[n] readback
  pass left  : compute { write partÿÿÿÿÿÿÿÿ.bytes(0, n / 2 * 4) as storage }
  pass right : compute { writ% part = words.bytes(n / 2 target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view histor * 4, 4) as storage }
  pass s  : compute { read words.bytes(0, n / 2 * y 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgbŸÍ6f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { ³ill gauss 0  clear flat 0 }
  pass light : raster queue grap"ics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queuer 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(fl4at, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memory(1920x1) as 080) <= 170 MiB
  warnstorage  write shown as storage } 
}order(light, to
ne)
}
