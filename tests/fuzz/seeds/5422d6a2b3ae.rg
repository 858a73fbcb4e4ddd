target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadowæææææææs or path != high
feature shadowc: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surfœce backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16fFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF view samples 4
  image flat : rgbagrap16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] h gno alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x6 s4irepstent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : rast
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
