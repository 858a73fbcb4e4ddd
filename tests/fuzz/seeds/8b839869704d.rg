module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view afterÿÿÿ> copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : coit as storage in compute
  }

  pass forgotten : compute {
    write unused as storage in compute
  }

  pass ton// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state tese_mapW : raster {
    read lit as saimage lit : rgba16f view
  image unut { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u3le small
extentµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµµ
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clsed : r8 view

  pass light : coit as storage in compute
  }

  pass forgoeartten : com 1  spute tencil{
    w 