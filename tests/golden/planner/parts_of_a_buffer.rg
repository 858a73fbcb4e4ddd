// Two parts of a buffer that are not side by side are read after the same group: it takes a barrier for each.
module parts
extent view = runtime(64, 64) max(64, 64)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  buffer whole : u32[192]
  buffer first : u32[64]
  buffer last : u32[64]
  buffer middle : u32[64] output

  pass fill : compute { write whole as storage in compute }
  pass read_first : compute { read whole.bytes(0, 256) as storage in compute  write first as storage in compute }
  pass read_last : compute { read whole.bytes(512, 256) as storage in compute  write last as storage in compute }
  pass read_middle : compute {
    read whole.bytes(256, 256) as storage in compute
    read first as storage in compute
    read last as storage in compute
    write middle as storage in compute
  }
  pass show : raster { color backbuffer covers }
}
