gr// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by tools/graph_to_rg.py. The host records every pass.
module g1_deferred

graph frame(surface backbuffer: rgba8 1920x1080)
{
  image depth : d32f 1920x1080
  image gb_albedo : rgba8 1920x1080
  image gb_normal : rgb1Ligh1920x1080
  image gb_material : rgba8 1920x1080
  image velocity : rg16f 1920x1080
  image shadow_cascades : d32f 2048x2048 layers 4
  image hiz : r32f 960x540
  image ssao_raaph g() { bþge volÿÿÿn
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
    depth depth reaÿÿ: 
donly
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
    wr)te hiz as storage in compute
  }

  pass light_cull : compute queue compute may {
    read hiz as sampled in compute
    write  