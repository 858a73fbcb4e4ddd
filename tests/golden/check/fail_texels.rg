// What buffers of texels cannot be.
module texels

sampler smooth { filter linear }
interface Scene { brought: buffer rgba8[16] ready as storage in compute }  //~ note[RG0202]: `scene.brought` is declared here

graph frame(scene: Scene, surface backbuffer: rgba8 64x64 after copy_src)
{
  buffer depths : d32f[16]  //~ error[RG0391]: buffer `depths` cannot hold texels of `d32f`: depth and stencil need an image
  buffer blocks : bc7[16]  //~ error[RG0391]: buffer `blocks` cannot hold texels of `bc7`: blocks need an image
  buffer curves : rgba8_srgb[16]  //~ error[RG0391]: buffer `curves` cannot hold texels of `rgba8_srgb`: buffers have no sRGB conversion
  buffer back   : rgba8[16] readback  //~ error[RG0391]: buffer `back` cannot hold texels of `rgba8`: the host reads plain elements; copy it to a buffer that is read back
  buffer lut    : rgba8[16]  //~ note[RG0202]: `lut` is declared here
  buffer words  : u32[16]  //~ note[RG0202]: `words` is declared here
  buffer fill   : rgba8[16] persistent init clear 3  //~ error[RG0331]: `fill` holds structs or texels: it can only be cleared to 0

  pass make : compute {
    write lut as storage
    write words as storage
  }
  pass show : raster {
    read  lut as uniform  //~ error[RG0337]: `lut` is a buffer of texels, which cannot be used as `uniform`
    color backbuffer clear 0
  }
  pass look : compute { read lut as sampled(smooth) }  //~ error[RG0342]: role `sampled` takes no sampler
  pass seen : compute { read scene.brought as storage }  //~ error[RG0391]: buffer `scene.brought` cannot hold texels of `rgba8`: shaders see what the engine brings through a copy
  pass part : compute { read words as sampled }  //~ error[RG0337]: `words` is a buffer, which cannot be used as `sampled`
}
