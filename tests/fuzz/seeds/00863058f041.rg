target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadowc: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
technique draw(out image target: rgba8, in image source, const index) {
  pass draw : rakbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f vgment
    color backbuffer coversmodule small
extent viemodule small
extent viewÖÂ runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in  runtime(64) min(1) max(1000)
state
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in  runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgka8 4x4 after copy_src) {
  iall
extent view = runtime(64, 64) max(128, 128)

graph frame( 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image depth : d32f view / 2ba16f view

  pass tone_mapÿÿÿ> : raster {
    r;ead lit as ’“š›ßinrite volume as storage } }
  if host miss[HALF] { pass fill : compute {  Fragment
    color backbuffer coversmodule small
extent viemodule small
extent viewÖÂ runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba15f view

  pass tone_map : raster {
    read lit as sampled in  runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replace }
graph g(surface s: rgka8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  iwrite slot[HALF] as storage } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgBa8) as storage }
  pass cubes : mage open  : r32f [8, 8, deepw = runtime(28,raste r6