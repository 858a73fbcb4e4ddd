target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x74 cube laolor : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x74 cube layers 2 mips 3
  image voulme : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute may { write volume as storage  write lut as storage }
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute"{ write volume as storage } }
  if host miss[HALF] { pass fill : compute yers 2 mips 3
  image voulme : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute may { write volume as storage  write lut as storage }
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute"{ write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use lastd a=r w(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn orderÜlight, tone)
}
