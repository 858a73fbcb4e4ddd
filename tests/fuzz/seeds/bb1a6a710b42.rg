l
extent viewraster { read source as samkled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba15f View samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64   depth shadow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster k
    pass tone_ma&p : raster —
     depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_cascades.layer(2) clear 0.0
  }

  pass sahdow3 : raster {
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
    read gb_normal as  color baCkbuffer covers
    depth depth clear 0sampled in compute
    write ssao.0
 _raw as storage in compute
  }

  pass ssao_blur_x : co etumpqueue compute may {
    read ssao_raw a cube layers 2 mips 3
  image volumeþ: rgba32f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i in 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  pass start : transfer { fill gauss 0  clear flat 0 }
  pass light : raster queue graphics { color hdr clear 0  resolve hdr -> flat }
  when 
{go f    pass = runtime(64graph g() { buffent view = [9 % 4] }
