// Bundles, directions at a use, layouts in one another.
module bundles

extent view = runtime(64, 64) max(64, 64)

struct Spin { axis: vec3  speed: f32 }  //~ note[RG0202]: `Spin` is declared here
struct Particle scalar {
  at:   vec3
  spin: Spin  //~ error[RG0340]: `scalar` does not go with `Spin`
}
technique tone(image source, inout image target) {  //~ note[RG0202]: `target` is declared here
  pass tone : compute {
    read   source as sampled
    update target as storage
  }
}

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image hdr  : rgba16f view

  bundle lit { with shadowed  read hdr as sampled }  //~ note[RG0452]: `shadowed` is used here
  bundle shadowed { with lit }  //~ error[RG0208]: `lit` is declared by means of itself
  bundle wrong { read hdr as smapled }  //~ error[RG0242]: there is no role called `smapled`

  bundle d0 { keep }
  bundle d1 { with d0  with d0 }
  bundle d2 { with d1  with d1 }
  bundle d3 { with d2  with d2 }  //~ note[RG0452]: `d2` is used here
  bundle d4 { with d3  with d3 }  //~ note[RG0452]: `d3` is used here
  bundle d5 { with d4  with d4 }  //~ note[RG0452]: `d4` is used here
  bundle d6 { with d5  with d5 }  //~ note[RG0452]: `d5` is used here
  bundle d7 { with d6  with d6 }  //~ note[RG0452]: `d6` is used here
  bundle d8 { with d7  with d7 }  //~ note[RG0452]: `d7` is used here
  bundle d9 { with d8  with d8 }  //~ note[RG0452]: `d8` is used here
  bundle d10 { with d9  with d9 }  //~ note[RG0452]: `d9` is used here
  bundle d11 { with d10  with d10 }  //~ note[RG0452]: `d10` is used here
  bundle d12 { with d11  with d11 }  //~ note[RG0452]: `d11` is used here
  bundle d13 { with d12  with d12 }  //~ note[RG0452]: `d12` is used here
  pass doubled : compute { with d13 }  //~ error[RG0257]: pass `doubled` takes more than 4096 statements from bundles
//~^ note[RG0452]: `d13` is used here
  pass light : compute { write hdr as storage  write backbuffer as storage }
  pass shade : compute { with lit }  //~ note[RG0452]: `lit` is used here
  for i in 0..2 { pass each[i] : compute { with wrong } }  //~ note[RG0452]: `wrong` is used here
  pass miss  : compute { with lut }  //~ error[RG0203]: there is no bundle called `lut`
  pass both  : raster { read hdr as sampled in fragment in vertex  color backbuffer clear 0 }  //~ error[RG0117]: `in` is set twice
  use tone(hdr, out backbuffer)  //~ error[RG0340]: `out` does not go with `target`
  use tone(hdr, backbuffer)  //~ note[RG0202]: `tone` is declared here
  use tone(hdr, backbuffer)  //~ error[RG0201]: `tone` is declared twice
}
