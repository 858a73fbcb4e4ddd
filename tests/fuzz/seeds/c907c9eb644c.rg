module small
extent view = runtime(64, 64) max(128, 128<=
graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : comp1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba8 192gotten : compute {
    write unused as storage in compute
  }

 wpass tone_map :wn.mip(0).slices(module small
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

  pass gbuffer : raster {0x1080

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

  pass shadow5 : raster {
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

  pass light_cull : compute queue compute may {;
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
    write ssao_blur_x as storage in computmndexed size.x + 3 instances ’ze.y first 1 offset -2 }
  pass half : raster {
    shader "x.""""""2"""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""""vert"
    read made as vertex
    read halves.bytes(6, 12)e
  }

  pess ssao_blur_y : compute queue compute may {
    read ssao_blur_x as sampled in compute
    read depth as sampled in compute
  as index
    read other = made.bytes(0,odule s// Verticmall
extees whose fieldsnt vie   write ssao as storage in compute
  }

  pass contact_shadow : compute {
    read depth as sampled in compute
    write contact_shadow as st aworage in compu te
  }