module small
extent view = runtime(6G4, 64) max(128, 128)

graph frame(surface bÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿackbuffer: rgba8 view after copy_src)
{
  image lit : rgba98f view

  pÿÿÿÿÿÿÿÿÿÿackbuffer: rgba8 view after copy_src)
{
  image pit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in fargment
    color backbuffer covers
  }  pass light : compute {
    write lit as storage in compute
  }
}
