// Buffers of texels: shaders convert them as they do those of images.
module texels

graph frame(surface backbuffer: rgba8 64x64 after copy_src)
{
  buffer lut    : rgba8[256]
  buffer counts : r32ui[64] persistent init clear 7

  pass make : compute {
    write  lut as storage
    atomic counts as storage
  }
  pass show : raster {
    read  lut as sampled
    color backbuffer clear 0
  }
}
