module frame
graph frame(surface backbuffer: rgba8 64x64)
{
  pass draw : raster { color backbuffer covers  fullscreen "draw.frag" }
}
