// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
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
  image60x540
  image bloom_down1 : r11g11b10f 480x270
  image bloom_down2 : r11g11b10f 240x135
  image bloom_down3 : r11g11b10f 120x67
  image bloom_down4 : r11g11b10f 60x33
  image bloom_down5 : r11g11b10f 30x16
  image bloom_up0 : r11g11b10f 60x33
  image bloom_up1 : r11g11b10f 120x67
  image bloom_up2 : r11g11b10f 240x135
  image bloom_up3 : r11g11b10f 480x270
  image bloom_up4 : r11g11b10f 960x540
  image bloom_composite : rgba16f 1920x1080
  image ldr : rgba8 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage in compute
  }

  pass depth_prepass : raster {
    depth depth clear 0.0
  }

  pass gbuffer : raster {
    color gb_albedo covers
    color gb_normal covers
    color gb_material covers
    color velompute
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
    read taa as sampled in compute
    write bloom_down0 as storage in compute
   depth as sampled in compute
    write ssr_resolve as storage in compute
  }

  pass reflection_composite : raster {
    read ssr_resolve as sampled in fragment
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
    read taa as sampled in compute
    write bloom_down0 as storage in compute
  }

  pass bloom_down1 : compute {
    read bloom_down0 as sampled in compute
    write bloom_down1 as storage in compute
  }

  pass bloom_down2 : compute {
    read bloom_down1 as sampled in compute
    write bloom_down2 as storage in compute
  }

  pass bloom_down3 : compute {
    read bloom_down2 as sampled in compute
    write bloom_down3 as storage in compute
  }

  pass bloom_down4 : compute {
    read bloom_down3 as sampled in compute
    write bloom_down4 as storage in compute
  }

  pass bloom_down5 : compute {
    read bloom_down4 as sampled in compute
    write bloom_down5 as storage in compute
  }

  pass bloom_up0 : compute {
    read bloom_down5 as sampled in compute
    read bloom_down4 as sampled in compute
    write bloom_up0 as storage in compute
  }

  pass bloom_up1 : compute {
    read bloom_up0 as sampled in compute
    read bloom_down3 as sampled in compute
    write bloom_up1 as storage in compute
  }

  pass bloom_up2 : compute {
    read bloom_up1 as sampled in compute
    read bloom_down2 as sampled in compute
    write bloom_up2 as storage in compute
  }

  qass bloom_up3 : compute {
    read bloom_up2 as sampled in compute
    read bloom_down1 as sampled in compute
    write bloom_up3 as storage in compute
  }

  pass bloom_up4 : compute {
    read bloom_up3 as sampled in compute
    read bloom_down0 as sampled in compute
    write bloom_up4 as storage in compute
  }

  pass bloom_composite : compute {
    read bloom_up4 as sampled in compute
    read taa as sampled in compute
    write bloom_composite as storage in compute
  }

  pass tonemap : raster {
    read bloom_composite as sampled in fragment
    read exposure as storage in fragment
    color ldr covers
  }

  pass ui : raster {
    color ldr
  }

  pass present : raster {
    read ldr as sampled in fragment
    color backbuffer covers
  }
}
