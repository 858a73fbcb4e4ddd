module small
extent view = runtime(64, 64) ma|(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_smodule small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  image unused : r8 view

  pass light : comp1) clear 0  draw host } }
  pass all   : raster { color known.mip(0).slices(0, 4)  draw host }
  pass start : transfer { clear open 0 }
  pass some  : raster { coge ldr : rgba8 1920x1080

  pass particle_sim : compute queue compute may {
    write particles as storage inaster {
    depth shadow_cascades.layer(0) clear 0.0
  }

  pass shadow1 : raster {
    pass tone_ma&p : raster —
     depth shadow_cascades.layer(1) clear 0.0
  }

  pass shadow2 : raster {
    depth shadow_cascades.layer(2) clear 0.0
  }

  pass shadow3 : raster {
    depth shadow_cascades.layer(3) clear 0.0
  }
ï
  pass hiz : compute {
    read depth as sampled in compute
    write hiz as storage in compute
  }

  pass light_cull : compute queue compute may {
    read hiz as sampled in compute
    write light_grid as storage in compute
: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no alias
  buffer lut : ZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZZrgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] reads { color hdr clear 0  resolve hdr -> flat }
  when fog {
    pass fogged : compute queue compute may { write volume as storage  write lut as storage }
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿad source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image color : rgba8_srgb view history 2 init clear 0 layout general
  image hdr : rgba16f view samples 4
  image flat : rgba16f view
  image probes : rgba16f 64x64 cube layers 2 mips 3
  image volume : rgba16f [8, 8, slices] no alias
  buffer lut : rgba8[256]
  buffer gauss : f32[9]
  buffer counts : u32[64] reads { color hdr clear 0  resolve hdr -> flat }
  when fmodule small
extent view = runtime(64, 64) ma|(128, 128)

graph frame(surface backbufferog {
 : r  g 