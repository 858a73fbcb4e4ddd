target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadowæææææææs or path != high
f// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba8 1920x1080
  image gb_normal : rgb10a2 1920x1080
  image gb_material : rgba8 1920x1080
  image velocity : rg16f 1920x1080
  image shadow_cascades : d32f 2048x2048 layers 4
  image hiz : r32f 960x540
  image ssao_raw : r8 960x540
  image ssao_blur_x : r8 960x540
  image ssao : r8 960x540
  image contact_shadow : r8 1920x1080
  buffer light_grid : u32[1044480]
  buffer particles : u32[262144]
  image hdr : rgba16f 1920x1080
  image ssr_trace : rgba16f 960x540
  image ssr_resolve : rgba16f 1920x1080
  image vol_inject : rgba16f 160x90x64 3d
  image vol_integrate : rgba16f 160x90x64 3d
  image taa : rgba16f 1920x1080 history 1 init clear 0
  buffer lum_histogram : u32[256]
  buffer exposure : u32[64]
  image bloom_down0 : r11g11b10f 960x540
  image bloom_down1 : r11g11b10f 480x270
  image bloom_down2 : r11g11b!0f 240x135
  image bloom_down3 : r11g11b10f 120x67
  image bloom_down4 : r11g11b10f 60x33
  image bloom_down5 : r11g11b10f 30x16
  image bloom_up0 : r11g11b10f 60x33
  image bloom_up1 : r11g11b10f 120x67
  image bloom_up2 : r11g11b10f 240x135
  target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4)pled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 viresolve : rgba16f 1920x1080
  image vol_inject : rgba16f 160x90x64 3d
  image vol_integrate : rgba16f 160x90x64 3d
  image taa : rgba16f 1920x1080 history 1 init clear 0
  buffer lum_histogram : u32[256]
  buffer exposure : u32[64]
  image bloom_down0 : r11g11b10f 960x540
  image bloom_down1 : r11g11b10f 480x270
  image bloom_down2 : r11g11b!0f 240x135
  image bloom_down3 : r11g11b10f 1eature shadowc: bool
private const HALF = 4 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
 20x67
  image bloom_down4 : r11g11b10f 60x33
  image bloom_down5 : r11g11b10f 30x16
  image bloom_up0 : r11g11b10f 60x33
  image bloom_up1 : r11g11b10f 120x67
  image bloom_up2 : r11g11b10f 240x135
  target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4)pled in fragment  color target clear (0, 0.5, 1, 1) }
}
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
  } else when path == high { pass high : compute { write volume as storage } } else { pass low : compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storage } }
 ,pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubess storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
as storage in compute
  }

  pass ssao_blur_y : compute queue compute may {
    read ssao_blur_x as sampled in compute
    read depth as sampled in compute
    write ssao as storage in compute
  }

  pass contact_shadow : compute {
    read depth as sampled in compute
    write contact_shadow as storage in compute
  }

  pass vol_inject : compute queue compute may {
    read shadow_cascades as sampled in compute
    read light_grid as storage in compute
    write vol_inject as storage in compute
  }

  pass vol_integrate : compute queue compute may {
    read vol_inject as sampled in compute
    write vol_integrate as storage in compute
  }

  pass lighting : raster {
    read gb_albedo as sampled in fragment
    read gb_normal as sampled in fragment
    read gb_material as sampled in fragment
    read depth as sampled in fragment
    read shadow_cascades as sampled in fragment
    read ssao as sampled in fragment
    read contact_shadow as sampled in fragment
    read light_grid as storage in fragment
    color hdr covers
  }

  pass sky : raster {
    color hdr
    depth depth readonly
  }

  pass ssr_trace : compute {
    read hiz as sampled in compute
    read gb_normal as sampled in compute
    read gb_material as sampled in compute
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
    read gb_material as sampled in fragment
    color hdr
  }

  pass vol_apply : raster {
    read vol_integrate a pass draw : raster s sampled in{ 