module sÂall
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

 epass tone_mapÿÿÿ> : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
    write litll
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view

 epass tone_mapÿÿÿ> : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : compute {
    write lit as storage in compute
  as storage in compute
  }ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ
}
