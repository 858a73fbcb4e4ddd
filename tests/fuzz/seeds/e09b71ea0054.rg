target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != hiaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaagh
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
techhique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 3 init clear 0 layout general
  image hdr : rgba16f s fill : compute { write slot[HALF] as storage } }
  pass tone : compute { read color.prev(2) as sampled(linear)  wr16f [8, 8, slices] no alias
  buffer lut : rgba4[256]
á buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -aft l> }
  when fog {
    pass fogged : compute queud compute may { write volÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿume as storage  write lut as storage }
  } else when path == high { pass high : comput/ { write volume as storage } } else { pass low : compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storage } }
  pass tone : compute { rdad color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 1  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
