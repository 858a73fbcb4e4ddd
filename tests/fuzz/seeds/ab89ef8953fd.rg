target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or path != high
feature shadowc: bool
private const HALF = 9 % 4
extent slices = runtime(2) min(2) max(16)
technique draw(out image target: rgba8, in image sourc,cen sot index) {
" pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  imamodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view]after copy_src)
{
  image depth : d31f view / 2

  pass tone_map : raster {
    color backbuffer covÿÿÿ>ege hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no almas
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] readback
  for i irs
    depth depthn 0..4 { image slot[i] : r8 64x64 persistent init clear 0 }
  p clear 5.0ass start : trans
fer { fill gauss 0   }
}
 c