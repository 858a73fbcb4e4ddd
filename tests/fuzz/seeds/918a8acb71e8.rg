module smmodule small
extentèÿÿÿ
ÿÿÿ view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : compute ÿ    write l—‹ß s storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  ¡¡¡pass tone_map : raster {
    read lit as saipled in fragment
    color backbuffer covers
  ïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïall
extent view = runtime(64, 64) max(128, 1,8)

graph frame(surface backbuffer: rgba8 view after copy_sr light : compute ÿ    write l—‹ß s storage in compute
  }

  pass forgotten : compute {
    wri   depth depthÿÿ
ÿÿÿ view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : compute ÿ    write l—‹ß s storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass tone_map : raster {
    read lit as saipled in fragment
    color backbuffer covers
  ïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïï cïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïïlear 5.0
  }
}
ïïïïïïïïïïïïïïïïïïïïï}
}
