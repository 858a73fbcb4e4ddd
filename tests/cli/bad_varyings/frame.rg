module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  pass draw : raster { shader "draw.vert" "NAME.frag"  color backbuffer clear 0  draw 3 }
}
