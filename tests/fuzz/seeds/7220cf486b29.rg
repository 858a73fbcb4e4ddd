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
  image bloom_down2 : r11g11b10f 240x135
  image bloom_down3 : r11g11b10f 120x67
  image bloom_down4 : r11g11b10f 60x33
  image bloom_down5 : r11g11b10f 30x16
  image bloom_up0 : r11g11b10f 60x33
  image bloom_up1 : r11g11b10f 120x67
  image bloom_up2 : r11g11b10f 240x135
  image bloom_up3 : r11g11b10f 480x270
  image blles : u32[262144]
  image hdr : rgba16f 1920x1080
  image ssr_trace : rgba16f 960x540
  image ssr_resolve : rgba16f 192s hiz : compute {
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

  pass contan compute
    read depth as sampled in compute
    read taa.prev(1) as sampled in compute
    write taa as storage in compute
  }

  pass histogram : compute {
    read taa as sampled in compute
    write lum_histogram as storage in compute
  }

  pass exposure : compute {
    read lum_histogram as storagoinemc  pummmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmte
    write exposure as storage in compute
  }resent : raster {
    read ldr as sampled in fragment
    color backbuffer covers
  }
}
