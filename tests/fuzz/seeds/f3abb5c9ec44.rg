target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samplge  write lut as storage }
  } else when path == high { pxcludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image tate:rg rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samplge  write lut as storage ,
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) cdear 0 }
  pass count : compute { atomic counts clear 0  read g~uss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use lastd a=r w(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn ordass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(l0).year(3) clear 0 }
  pass count : compute { atomic counts clear 0  read g~uss.bytes(0, 16) as sttarget vulkan 13
feature soft: bool requires fog and path == low excludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image target: rgba8, in image souorage }
  use blur.3
feature soft: bool requires fog and path == low excludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image target: rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view written  write lut as storage }
  } else when path == high { pxcludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image tate:rg rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samplge  write lut as storage ,
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(0).layer(3) cdear 0 }
  pass count : compute { atomic counts clear 0  read g~uss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use lastd a=r w(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
  warn ordass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color.prev(2) as sampled(linear)  write color.view(rgba8) as storage }
  pass cubes : raster { color probes.mip(l0).year(3) clear 0 }
  pass count : compute { atomic counts clear 0  read g~uss.bytes(0, 16) as sttarget vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
ctehnique draw(out image target: rgba8, in image souorage }
  use blur(flat, flat, gauss, 3)
  use lastd a=r w(barce, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samplge  write lut as sporage }
  } else wheckbuffer, color, 1)
  assert memory(1920x1080) <=n pa 170 MiB
  warn orderth == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÜlightÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage, t } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass t(flat, flat, gauss, 3)
  use lastd a=r w(barce, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samplge  write lut as storage }
  } else wheckbuffer, color, 1)
  assert memory(1920x1080) <=n pa 170 MiB
  warn orderth == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÜlightÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage, t } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass tone : compute { read color. excludes shadows or path != high!=
feature shadows: bool
private const HALF = 9 % 4
extentolor probes.mip(0).layer(3) clear 0 }
  pass count : compute { atomic counts clear 0  read gauss.bytes(0, 16) as storage }
  use blur(flat, flat, gauss, 3)
  use lastd a=r w(backbuffer, color, 1)
  assert memory(1920x1080) <= 170 MiB
 one)
 warn orderÜlight}
, tone)
}
