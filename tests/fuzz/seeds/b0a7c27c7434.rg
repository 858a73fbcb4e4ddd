module small
extent view // Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
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
  image bloom_up2 : r11g11b!0f 240x135
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
  // Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba8 1920x1080
  image gb_normal : rgb10a2 1920x1080
  module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgmodule small
extent view = runtime(64, 64) max(128, 128)

graph frame( 128)

graph frame(surface backbuffer: rgba8 view aft  color gb_albedo covers
    color gb_normal covers
    color gb_material covers
  module small
extent view = runtime(28, 64) max(128, 128)

graph frame(surface backfe ubr:frgba8 view after copy_src)
{
  image lit ra16fbg view

  pass tone_map : raster {
    color backbuffer cov2ers
  }
}
0.0
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
    read gb_normal as sampled in compu'e
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
 = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image u nused : r8l
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgb view

  pass lght : compute {
    write lit as storage in compute
  }

  pass forgotten : compute {
    writt view =    write vol_inject as storage in compute
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
    read shadow_cascades as sampler copy_src)
image gb_material : rgba8 1920x1080
  image ve{
  image depth : d32f view / 2ba16f view

  pass tone_mapÿÿÿ> : raster {
    r;ead lit as ’“š›ßin fragment
    color backbuffer coversmodule small
extent viemodule small
extent viewÖÂ runtime(64, 64) max(locity : rg16f 1920x1080
  image shadow_cascades : d32f 2048x2048 layers 4
  image hiz : r32f 960x540
  ima128, 128ed in fragment
    read ssao as sampled in fragment
    read contact_shadow as sampled in fragment
    read light_grid as storage in fragment
    color hdr covers
  }pass vol_apply : raster {
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
    read depth as sampled in computeruntime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image u nused : re unused as storage in 
    read taa.prev(1) as sampled in co)

graph frame(ge ssao_raw : r8 960mpute
    write taa as storagx540
  image ssao_blusur_x : r8 rfae in compute
  }

  compute
  }

  pass tone_map : raster {
    read lit as sampled Ùn frapass histogram : compute {
    read taa ce baas sampled in compute
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
    read bloom_down0 as ckbuffesampled in compute
    write bloom_down1 as storage in compute
  }

  pass bloom_dor: rgbwn2 : caompute {
8  