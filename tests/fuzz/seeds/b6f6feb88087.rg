module smme(64, 64) max(128, 128)

graph frame(rsuface backbuffer: rgba8 view after copy_src)
{
  image depth : d32f viw/ e2 oooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooooo
 
 pass tone_map : raster {
    color -backbuffer covers
创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创创    depth depth clear 0.0
  }
}
