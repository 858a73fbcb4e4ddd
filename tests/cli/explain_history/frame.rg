module frame
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  buffer state : u32[64] history 1 init clear 0
  buffer older : u32[64] history 2 init clear 0

  pass step   : compute { read state.prev(1) as storage  write state as storage }
  pass remember : compute { read older.prev(2) as storage  write older as storage }
  pass show   : raster { color backbuffer clear 0 }
}
