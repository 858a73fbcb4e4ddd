module small
target profile "basic.json"
graph frame(surface backbuffer: rgba8 64x64 after copy_src)
{
  buffer draws : u32[64]
  buffer count : u32[1]
  pass reset : transfer { fill draws 0  fill count 0 }
  pass show : raster { shader "show.vert" "show.frag"  color backbuffer clear 0  draw indirect draws max 4 count count }
}
