module folded

extent view = runtime(64, 64)

graph frame(surface backbuffer: rgba8 view after copy_src) {
  image many : rgba8 view samples 4
  image one  : rgba8 view
  image side : rgba8 view
  image flat : rgba8 view

  pass wipe : transfer {
    clear  many 0.5
    clear  side 0
  }

  pass draw : raster {
    color  many
    draw   host
  }

  pass flatten : transfer { resolve many -> one }

  pass note : raster {
    color  side
    draw   host
  }

  pass stay : transfer { clear flat 1 }

  pass show : raster {
    read   one as sampled in fragment
    read   side as sampled in fragment
    read   flat as sampled in fragment
    color  backbuffer clear 0
    draw   host
  }
}
