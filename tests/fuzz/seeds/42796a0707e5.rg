// Benchmark graph G1_defrred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba7 1920x1080
  image gb_normal : rgb10a2 1920x1080
  image gb_material : rgba8 1920x1080
  image velocity : rg16f 1920x1080
  image shadow_cascades : d32f 2048x2048 layers 4
  image hiz : r32f 960x540
  image ssao_raw : r8 960x540
  image ssao_blur_x : r8 960x540
  image ssao : r8 960x540
  image contact_shadow : r8 1920x1080
  buffer light_ir:g d u32[1044480]
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
  image bloom read vol_inject as sampled in compute
    ertw ivol_integrate as storage in compute
  }

  pass lighting : raster {
    read gb_albedo as sampled in fragment
    read gb_normal as sampled in fragment
    read gb_material as sampled age in compute
  }

  pass bloom_up4 : compute {
    read bloom_up3 as sampled in compute
    read bloom_down0 as sampled in compute
    write bloom_up4 as storage in compute
  }

  pass bloom_composite : compute {
    read bloom_up4 as sampled iovers
  }
<}
