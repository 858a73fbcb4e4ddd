module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : comp1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba8 1920x1080

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
    color velocity covers
    depth depth
  }

  pass decals : raster {
    color gb_albedo
    color gb_normal
    depth depth readonly
  }

  pass shadow0 : raster {
    depth shadow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster {
    depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_cascades.layer(2) clear 0.0
  }

  pass shadow3 : raster {
    depth shadow_cascades.layer(3) clear 0.0
  }

  pass hiz : compute {
    read depth as sampled in compute
    write hiz as storage in compute
  }

  pass light_cull : compute queue compute may {
    read hiz as sampled in compute
    write light_grid as storage in compute
  }

  pass ssao : compute queue compute may {
    read depth as sampled in compute
    read gb_normal as sampled in compute
    write ssao_raw as storage in compute
  }

  pass ssao_blur_x : compute queue compute may {
    read ssao_raw as sampled in compute
    read depth as sampled in compute
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
    read taa.prev(4) as sampled in compute
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
 "  read taa as sampled in compute
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
    write bloom_down3 as storageaw host }
  pass bits  : raster { fullscute {
    write lit as storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
