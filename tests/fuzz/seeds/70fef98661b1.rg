module small
extent view = runtime(64, 64) max(128, 1tlenxtraph frame(surface backbuffer: rgba8 view afterÿÿÿ> copy_src)
{
  image lit : r>=a16f view
  image unused : r8 view

  pass light : coit as storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass 4) max(128, 12r8g)

aph frame(surface backbuffer: rgba8 viewime(64, 64) max(128, 128)

graph frame( after copyffer: {
  image lit : rgba16f view
  image unused : r8 view

  pass light : compute {
    write lit as storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass tonton// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state tese_mapW : r4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass tonton// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state tese_mapW : r4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u3le small
extent view = runtime(64, 64) max(128, 12r8g)

aph frame(surface backbuffer: rgba8 viewime(64, 64) max(128, 128)

g).slice(z) } }
  for z in 0..2 { pass less[z] : raster { color known.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { color open.slices(1, 3) clear 2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clsed : r8 view

  pass light : coit as storage in compute
  }

  pass forgoeartten : com 1  spute tencil{
    w 