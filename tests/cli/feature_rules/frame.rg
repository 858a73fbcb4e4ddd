module small
feature shadows: bool
feature soft: bool requires shadows
graph frame(surface backbuffer: rgba8 64x64 after copy_src)
{
  pass show : raster { color backbuffer clear 0 }
  when shadows { pass shadow : raster { color backbuffer } }
  else { pass plain : raster { color backbuffer } }
  when soft { pass soften : raster { color backbuffer } }
  else { pass sharpen : raster { color backbuffer } }
}
