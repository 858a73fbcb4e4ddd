module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in  runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
grmodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgmodule small
extent view = runtime(64,state 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after(copy_src)
{
  image depth : d32f view / 2ba16f view

  pass tone_mapÿÿÿ> : raster {
    read lit as sampled in fragment
    color backbuffer covers
  }
  pass light : comp

  pass tone_map :êv2 raster {
    color backbufute {fer covers
    depth depth clear 0.0
  }

    write lit as storage i}
n compute
  }ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ
}
host }
  pass start : transfer { clear ÿÿÿopen 0 }
  pass some  : raster { color open.slices(0, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { fr@gment
    color backJuffer covers
  }
  pass light : compute {
    write lit as storage in compute
  }
}
