// Ports of techniques: their types, and what `out` promises.
module ports

extent view = runtime(64, 64) max(64, 64)

technique fade(image source: rgba16f, out image target: rgba8) {  //~ note[RG0202]: `source` is declared here
//~^ note[RG0202]: `target` is declared here
  pass fade : compute {
    read   source as sampled
    update target as storage  //~ error[RG0254]: parameter `target` is declared `out`: its contents are not known before the technique has written it
  }
}
technique blank(out image target) {  //~ error[RG0253]: parameter `target` is declared `out`, but technique `blank` never writes it
  image own : r8 4x4
  pass nothing : compute { write own as storage }
}
technique weigh(buffer weights: f32, inout image target: rgba9) {  //~ note[RG0202]: `weights` is declared here
  pass weigh : compute {
    read   weights as storage
    update target as storage
  }
}

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image  hdr   : rgba16f view
  image  sharp : rgba8 view
  image  low   : r8 view  //~ note[RG0202]: `low` is declared here
  buffer words : u32[4]  //~ note[RG0202]: `words` is declared here
  pass light : compute {
    write hdr as storage
    write words as storage
    write low as storage
  }
  use fade(hdr, sharp)  //~ note[RG0452]: `fade` is used here
  use wrong = fade(low, sharp)  //~ error[RG0252]: parameter `source` takes `rgba16f`, and `low` is `r8`
  use none = fade(4, sharp)  //~ error[RG0238]: expected a resource or a part of one
  use weigh(words, low)  //~ error[RG0252]: parameter `weights` takes `f32`, and `words` is `u32`
  pass show : raster { color backbuffer clear 0 }
}

graph other(surface backbuffer: rgba8 view after copy_src)
{
  image sharp : rgba8 view
  use blank(sharp)  //~ note[RG0452]: `blank` is used here
  pass show : raster { color backbuffer clear 0 }
}

technique paint(out image target) {
  pass first : raster { color gone clear 0 }  //~ error[RG0203]: there is no resource called `gone`
  pass second : raster { color target }
}
graph painted(surface backbuffer: rgba8 view after copy_src)
{
  use paint(backbuffer)  //~ note[RG0452]: `paint` is used here
}
