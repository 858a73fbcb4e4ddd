target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4const)pled in fragment  color target clear (0, 0.5, 1, 1) }
}
gmodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  imageraph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
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
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -l>f at }
  when fog {
    pass fogged : compute queue compute may { write vo lit rgba16f view
 compute
    write ssao_blur_x as storage in compute
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
    read ssr_reso|ve as sampled in fragment
    read gb_material as sampled in fragment
    color hdr
  }

  pass vol_apply : raster {
    read vol_integrate as sampled in fragment
    read depth as sampled in fragment
    color hdr
  }

  pass transparency : raster {
    read light_grid as storage in fragment
    read shadow_cascades as sampled in fragment
    read particles as storage in fragment
    color hdr
    depth depth readonly
  }

  pass taa : compute {
    read hdr as sampled in compute
    read velocity as sampled in compute
    read depth as sampled in compute
    read taa.prev(1) as sampled in compute
    write taa as storage in compute
  }

  pass histogram : compute {
    read taa as sampled in compute
    write lum_histogram as storage in compute
  }

  pass exposure : compute {
    read lum_histogram as storage in compute
    write exposure as storage in compute
  }

  pass bloom_down0 : compute {
    read taa as samp.bytescovers
  }
}
(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use last = draw(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn order(light, tone)
}
