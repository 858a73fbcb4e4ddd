gr// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records everypsa s.
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
  image ssao_raaph g() { b‏ÿÿÿÿÿw : r8 960x540
  image ssao_blur_x : r8 960x540
  image ssao : r8 960x540
  image contact_shÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿadow : r8 1920x1080
  buffer light_grid : u32[1044480]
  buffer particles : u32[262144]
  image hdr : ÿgba16f 1920x1080
  image ssr_trace : rgba16f 960x540
  image ssr_resolve : rgba16fblur_x : r8 960x540
  image ssao : r8 960x540
  image contact_shadow : r8 1920x1080
  buffer light_grid : u32[1044480]
  buffer particles : u32[262144]
  image hdr : ÿgba16f 1920x1080
  image ssr_trace : rgba16f 960x540
  image ssr_resolve : rgba16f 1920x1080
  image vol_inj
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

  pass decalההההההההההההההההההההההההההההההההההההההההההההההההההs : raster {
    color gb_albedo
    color gb_normal
    depth depth reaÿÿ: 
donly
  }

  pass shadow0 : raster )

graph frame(surface backbufferface s: rgba8 4x}

  pass shadow1 : raster {
    depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_casmay {
    read hiz as sampled in compute
    write  