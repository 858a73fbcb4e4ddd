module m
extent view = runtime(64, 64) max(128, 128)
graph k(surface backbuffer: rgba8 view after copy_src) {
  image a : r8 view
  pass w : compute {
    shader "w.comp" group 8 8 1
    write a as storage
    dispatch over view
  }
  pass s: raster { color backbuffer clear 0 }
}
