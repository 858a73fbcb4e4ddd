module accesses
struct Big { m: mat4[3] }
struct Pair { a: u32  b: u32 }
sampler compares { compare less }  //~ note[RG0202]: `compares` is declared here
sampler smooth { filter linear }  //~ note[RG0202]: `smooth` is declared here
graph g(surface s: rgba8 4x4) {  //~ note[RG0202]: `s` is declared here
  image color : rgba8 4x4 mips 2  //~ note[RG0202]: `color` is declared here
  image depth : d32f 4x4  //~ note[RG0202]: `depth` is declared here
  image ids : r32ui 4x4  //~ note[RG0202]: `ids` is declared here
  image srgb : rgba8_srgb 4x4  //~ note[RG0202]: `srgb` is declared here
  image block : bc1 4x4  //~ note[RG0202]: `block` is declared here
  buffer data : u32[16]  //~ note[RG0202]: `data` is declared here
  buffer pairs : Pair[4]
  pass p1 : compute { read color }  //~ error[RG0335]: `read color` needs a role, such as `as sampled` or `as storage`
  pass p2 : compute { read color as smapled }  //~ error[RG0242]: there is no role called `smapled`
  pass p3 : compute { write color as sampled }  //~ error[RG0336]: `write` does not go with role `sampled`
  pass p4 : compute { read data as sampled }  //~ error[RG0337]: `data` is a buffer, which cannot be used as `sampled`
  pass p5 : transfer { read data as storage }  //~ error[RG0338]: a transfer pass cannot use `data` as `storage`
  pass p6 : compute { read data as storage in fragment }  //~ error[RG0339]: a compute pass has no such stage
  pass p7 : compute { color s }  //~ error[RG0341]: `color` is an attachment: it belongs in a raster pass
  pass p8 : compute { read color as sampled clear 0 }  //~ error[RG0340]: `clear` does not go with `read`
  pass p9 : compute { read data as storage(smooth) }  //~ error[RG0342]: role `storage` takes no sampler
  pass p10 : compute { read s as sampled(compares) }  //~ error[RG0343]: sampler `compares` compares depths, but `s` is of format `rgba8`
  pass p11 : compute { read ids as sampled(smooth) }  //~ error[RG0344]: sampler `smooth` filters, but `ids` holds integers (`r32ui`)
  pass p12 : raster { color ids clear 0.5 }  //~ error[RG0333]: `ids` holds integers (`r32ui`): the value for it must be whole and in range
  pass p13 : raster { color ids blend add(one, one) }  //~ error[RG0346]: `ids` holds integers (`r32ui`) and cannot be blended
  pass p14 : raster { color s blend add(one) }  //~ error[RG0345]: a blend takes two factors, or four with those of alpha, not 1
  pass p15 : raster { color s blend plus(one, wun) }  //~ error[RG0245]: there is no blend factor called `wun`
//~^ error[RG0245]: there is no blend operation called `plus`
  pass p16 : raster { color depth clear 0 }  //~ error[RG0347]: `depth` is of format `d32f` and cannot be a colour attachment
  pass p17 : raster { depth s clear 0 }  //~ error[RG0348]: `s` is of format `rgba8` and cannot be a depth attachment
  pass p18 : raster { stencil depth clear 0 }  //~ error[RG0348]: `depth` is of format `d32f` and cannot be a stencil attachment
  pass p19 : raster { color block clear 0 }  //~ error[RG0325]: `block` is block-compressed (`bc1`) and cannot be an attachment
  pass p20 : compute { write srgb as storage }  //~ error[RG0349]: `srgb` is of format `rgba8_srgb`, which images used as `storage` cannot have
  pass p21 : compute { write block as storage }  //~ error[RG0325]: `block` is block-compressed (`bc1`) and cannot be used as storage
  pass p22 : compute { write color as storage }  //~ error[RG0350]: `color` has 2 mips and `storage` takes one: say `color.mip(i)`
  pass p23 : compute { atomic pairs as storage clear 4 }  //~ error[RG0331]: `pairs` holds structs or texels: it can only be cleared to 0
  pass p24 : compute { read color as sampled(missing) }  //~ error[RG0203]: there is no sampler called `missing`
  pass p25 : raster { color s blend add(one, one) readonly }  //~ error[RG0340]: `readonly` does not go with `color`
  pass p26 : compute { read data as storage in fragmnt }  //~ error[RG0243]: there is no stage called `fragmnt`
  pass p27 : transfer { read color as blit_src }  //~ error[RG0350]: `color` has 2 mips and `blit_src` takes one: say `color.mip(i)`
}
