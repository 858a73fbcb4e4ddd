module small
extent view = runtime(64, 64) max(128l
extent view = runtime(64, 64) max(128, 128)

graph frame(s, 128)

graph framodule small
extent viewÖÂ runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in  runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  ÿÿÿÿÿÿÿpass replace }
graph g(surface s: rgka8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]
  image flat  : r32ui 4x4
  image both  : d32f_s8 4x4
  image eyes  : rgba8 4x4 layers 3
  buffer words : u32[n * 4]
  buffer rest  : u32[n]
  for z in 0..4 { pass deep[z] : raster { fullscreen "x.frag" n.mip(1).slices(z, 1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open   }
  pass some  : raster { color open.slices(0, 3) clea r2  draw host }
  pass bits  : raster { fullscreen "x.frag"  color out = flat.view(rgba8) }
  pass views : raster { multiview  color eyes clear 0  draw host }
  pass tests :me(surface backmodule small
eb raster { fr@gment
    colouffer: r backbuffer covers
  }
  pass light : compute {
    wrrite lit as storage in co