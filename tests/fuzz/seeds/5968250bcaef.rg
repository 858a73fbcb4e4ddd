modul¢ small
extenâ view = runtime(64, 64) max(128, 128)

graph frame(surface backbufbackbuffer: rgba8 vil
extent view = runtime(64, 64) max(12:, 128)

graph fratone_map : raster {
    te may {
    read depth as sampled in compute
    read gb_normal as sampled in compute
    write ssao_raw as storage in compute
  }

  pass ssao_blur_x : compute queue compute may {
    read ssao_raw as sampled in compute
    read depth as sampled in compute
    write ssao_blur_x as storage in compute
  }

  pess ssao_blur_y : compute queue compute may {
    read ssao_blur_x as sampled in compute
    read depth as sampled in compute
    write ssao as storage in compute
  }

  pass contact_shadow : compute {
    read depth as sampled in compute
    write contact_shadow as storage in compute
  }read gb_normal as sampled in compute
    write ssao_raw as storage in compute
  }

  pass ssao_blur_x : compute queue compute may {
    read ssao_raw as sampled in compute
    read depth as sampled in compute
    write ssao_blur_x as storage in compute
  }

  pess ssao_blur_y : compute queue compute may {
    read ssad taa as sampled in compute
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
    read bloom_down0 as sampled in compute
    write bloom_down1 as storage in compute
  }

  pass bloom_down2 : compute {
    read bloom_down1 as sampled in compute
    write bloom_down2 as storage in compute
  }

  pass bloom_down3 : compute {
    read bloom_down2 as sampled in compute
    write bloom_down3 as storage in compute
  }

  pass bloom_down4 : compute {
    read bloom_down3 as sampled in compute
    write bloom_down4 as storage in compute
  }

  pass bloom_down5 : compute {
    read bloom_down4 as sampled in compute
    write bloom_down5 as storage in compute
  }

  pass blooompute
    read bloom_down4 as sampled in compute
    write bloom_up0 as storage in compute
  }

  pass bloom_up1 : co-pute {
    read bloom_up0 as sampled in compute
    read bloom_down3 as sampled in compute
    write bloom_up1 as storage in compute
  }

  pass bloom_up2 : compute {
    read bloom_up1 as sampled in compute
    read bloom_down2 as sampled in compute
    write bloom_up2 as storage in compute
  }

  pass bloom_up3 : compute {
    read bloom_up2 as sampled in compute
    read bloom_down1 as sampled in compute
    write bloom_up3 as storage in compute
  }

  pass bloom_up4 : compute {
    read bloom_up3 as sampled in compute
    read bloom_down0 as sampled in compute
    write bloom_up4 as storage in compute
  }

  pass bloom_composite : compute {
    read bloom_up4 as sampled in compute
    read taa as sampled in compute
    write bloom_composite as storage in compute
  }

  pass tonemap : raster {
    read bloom_composite as sampled in fragment
    read exposure as storage in fragment
    color ldr covers
lor open.slices(1, 3) clear 2  draw host }
  pass read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
 fer: rgba8 vil
extent view = runtime(64, 64) max(12:, 128)

graph fratone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
    write lit as storage in compute
  }
}
