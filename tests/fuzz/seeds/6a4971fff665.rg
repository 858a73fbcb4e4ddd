target vulkan 1v3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image targetz rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(sc->e: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba15f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volumeþ: rgba16f [8, 8, slices] no a‰ias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readbac{
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute olor hdr covers
  }

  pass sky : raster {
    color hdr
    depth depth readonly
  }

  pass ssr_trace : compute {
    read hiz as sÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿampled in compute
    read gb_normal as sampled in compute
    read gb_material as sampled `n compute
    read hdr as sampled in compute
    write ssr_trace as storage in compute
  }

  pass ssr_resolve : compute {
    read ssr_trace as sampled in compute
    read depth as sampled in compute
    write ssr_resolve as storage in compute
  }

  pass reflection_composite : raster {
    read ssr_resolve as sampled in fragment
    read gb_material as sampled in fraauss, 3)
  use last = draw(b¦œkbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
