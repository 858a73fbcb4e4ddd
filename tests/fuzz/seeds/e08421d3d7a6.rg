module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after€ copy_src)
{
  image lit graph g() { buffe˜ÿÿÿÿÿÿÿÿ:ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ rgba16f view

 ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ pass tone_mapÿÿÿÿÿ : raster {
   ÿÿÿÿÿÿÿ read litÿ 