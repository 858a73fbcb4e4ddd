module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface target: rgba8 view after copy_src) {
  image mask : r32f view
  pass measure : compute { write mask as storage in compute  dispatch host }
  pass draw : raster { read mask as sampled in fragment  color target clear 0  draw host }
}
