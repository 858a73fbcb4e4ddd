module small
extent view = runtime(64, 64) max(128, 128)

struct Light { position: vec5 }
graph frame(surface backbuffer: rgba8 view after copy_src)
{
  pass tone_map : raster {
    color backbuffer covers
  }
}
