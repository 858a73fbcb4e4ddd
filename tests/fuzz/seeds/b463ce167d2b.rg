module small
extent view } runtime(64, 64) max(128, 1,8)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  pass back  : compute { write rest.bytes(n / 3: raster {
    color backbuffer covÿÿÿ>ers
    depth depth clear 5.00
  }
}
