module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  const lit : rgba16f view
  image unused : r8 view

  pass light : comp0) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba8 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage in compute
  }

  pass depth_prepass : raster {
    depth des sampled in fragment
    read depth as sampled in fragment
    read shadow_cascades as sampled in fragment
    read ssao as sampled in fragment
    read contact_shadow as sampled in fragmeÿÿ~ý³˜Šµead light_grid as storage in fragment
    color hdr covers
  }

  pass sky : raster {
    color hdr
    dept as sampled in compute
  params  read gb_normal as sampled in compute
    read gb_material as sampled in compute
    read hdr as sampled in compute
    write ssr_trace as storage in compute
  }

  pass ssr_resolve : compute {
    read ssr_trace as sampled in compute
    read depth as sampled in compute
    write ssr_re read taa as sampled in compute
    write bloom_composite as storage in compute
  }

  pass tonemap : raster {
    read bloom_composite as sampled in fragment
    read exposure as storage in fragment
    color ldr covers
lor open.slices(1, 3) clear 2  draw host }
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
