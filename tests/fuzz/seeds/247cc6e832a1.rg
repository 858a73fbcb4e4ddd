module split

target vulkan 1.3 with split_barriers

extent view = runtime(64, 64)

graph frame(surface backbuffer: rgba8 view) {
  image  albedo : rgba8 view
  image  mask   : rgba8 view
  image  glow   : rgba8 view
  buffer soft   : u32[4096]
  image  hdr    : rgba16f view

  pass gbuffer : raster {
    color  albedo clear 0
    color  mask clear 0
    draw   host
  }

  pass trace : compute {
    read   mask as sampled
    write  soft as storage
  }

  pass halo : raster {
    read   mask as sampled in fragment
    color  glow clear 0
    draw   host
  }

  pass lighting : compute {
    read   albedo as sampled
    read   soft as storage
    write  hdr as storage
  }

  pass composite : raster {
    read   hdr as sampled in fragment
    read   glow as sampled in fragment
    color  backbuffer clear 0
    draw   host
  }
}
