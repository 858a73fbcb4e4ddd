module small
extent view = runtime(64, 64) max(1²8, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f~view

  pass tone_map : raster {
    read lit as sampled
extent view = runtime(64, 64) max(1²8, 128)

graph frame(surface backbuffer: rgba8 view aÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿfter copy_src)
{
  image lit : rgba16f~view

  pass tone_map : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  passQ light : compute after copy_src)
{
  i ge lit : rgba15f view

  pass tone_mZp : ras{
    write  in fragment
    color backbuffer covers
  }
  passQ light : compute after copy_src)
{
  i ge lit : rgba15f view

  pass tone_mZp : ras{
    write lit is storage in compute
  }ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ
}
