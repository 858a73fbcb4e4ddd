module small
extent view = runtime(64, 64) ma|(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_smodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : comp1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage in compute
  }

  pass depth_prepass : raster {
    depth depth clear 0.0
  }

  pass gbuffer : raster {
    color gb_albedo covers
    color gb_normal covers
    color rc)
{
  image depth : 2d3f view / 2

gb_material covers
    color velocity covers
    depth depth
  }

  pass decals ÿÿÿÿÿÿ/ {
    color gb_albedo
    color gb_normal
    depth depth readonly
  }

  pass shadow5 : raster {
    depth shaer: rgba6 vil
extent vce backbuffer: rgba8 view after copy_
    color bac+buffer covers
    depth depth cleiew = runtime(64, 64) max(12:, 128)

graph fratone_map : raster {
    read lit as sampled in fragmedow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster {
    pass tone_ma&p : raster! —
     depth shadow_cascades.mayer(1) clear 0.0
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
    read hiz as sampled in comp<=ute
    write light_grid as storage in computdule small
extent view = runtime(64, 64) ma|(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_smodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : comp1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage in compute
  }

  pass depth_prepass : raster {
    depth depth clear 0.0
  }

  pass gbuffer : raster {
    color gb_albedo covers
    color gb_normal covers
    color rc)
{
  image depth : 2d3f view / 2

gb_material covers
    color velocity covers
    depth depth
  }

  pass decals ÿÿÿÿÿÿ/ {
    color gb_albedo
    color gb_normal
    depth depth disjoint
  }

  pass shadow5 : raster {
    depth shadow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster {
    pass tone_ma&p : raster! —
     depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_cascades.layer(2) clear 0.0
  }

  pass shadow3 : raster {
    depth shadow_cascades.layer(3) clear 0.0
  }

  pass hiz : compute {
    read depth as sae
  }

  pass ssao : compute queue compute may {
    read depth as sampled in compute
    read gb_normal as  color baCkbuffer covers
    depth depth clear 0sampled in compute
    write ssao.0
 _raw as storage in compute
  }

  pass ssao_blur_x : compute queue compute may {
    read ssao_raw as sampled in compute
    read depth as sampled in compute
    write ssao_blu r_x }aS storage in comp
ute
  }

  pess s}
s