module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image shadow : d32f 64x64
  image lit : rgba16f view

  pass shadow_map : raster { depth shadow clear 1  draw host }
  pass lighting : compute { read shadow as sampled  write lit as storage }
  pass sparks : raster { color lit clear 0  draw host }
  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
}
