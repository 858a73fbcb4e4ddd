module small
extent view = runtime(64, 64) max(128, 128)

technique blur(image source: rgba16f, inout image target) {
  image half : rgba16f source / 2
  pass down : compute { read source as sampled  write half as storage }
  pass up : compute { read half as sampled  update target as storage }
}

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image soft : rgba16f view
  pass light : compute { write lit as storage }
  pass start : compute { write soft as storage }
  use wide = blur(lit, inout soft)
  for i in 0..2 { use eyes[i] = blur(lit, soft) }
  pass tone_map : raster {
    read soft as sampled in fragment
    color backbuffer covers
  }
}
