module taken
const plan = 3
const INT_MAX = 4
extent view = runtime(64, 64) max(128, 128)
graph taken(surface backbuffer: rgba8 view after copy_src) {
  pass s: raster { color backbuffer clear 0 }
}
