module places
struct Pair { a: u32  b: u32 }
interface Scene { lights: buffer Pair[] ready as storage in comput  odd: image rgba8 4x4 ready as somehow }  //~ error[RG0242]: there is no role called `somehow`
//~^ error[RG0243]: there is no stage called `comput`
graph g(scene: Scene, surface s: rgba8 4x4) {
  image a : rgba8 8x8 mips 2 layers 3  //~ note[RG0202]: `a` is declared here
  image h : rgba8 8x8 history 2 init clear 0  //~ note[RG0202]: `h` is declared here
  buffer b : u32[16]
  pass p1 : compute { write a.mip(2) as storage }  //~ error[RG0311]: `a` has 2 mips; 2 is not among them
  pass p2 : compute { write a.mip(0).layers(1, 3) as storage }  //~ error[RG0311]: `a` has 3 layers; 1 to 3 is not among them
  pass p3 : compute { write a.depth as storage }  //~ error[RG0310]: `a` has no depth aspect
  pass p4 : compute { write b.mip(0) as storage }  //~ error[RG0312]: `b` is a buffer, which has no `mip`
  pass p5 : compute { read a.prev(1) as sampled }  //~ error[RG0307]: `a` keeps no history
  pass p6 : compute { read h.prev(3) as sampled }  //~ error[RG0308]: `h` keeps `history 2`: there is no `prev(3)`
  pass p7 : compute { write h.prev(1) as storage }  //~ error[RG0309]: `h.prev(1)` belongs to an earlier frame; only `h` can be written
  pass p8 : compute { write b.bytes(0, 0) as storage }  //~ error[RG0313]: the byte range is empty or begins before the buffer
  pass p9 : compute { write a.mop(0) as storage }  //~ error[RG0223]: there is no part called `mop`
  pass p10 : compute { write a.mip(0, 1) as storage }  //~ error[RG0225]: `mip` does not take 2 arguments
  pass p11 : compute { write scene.lihgts as storage }  //~ error[RG0203]: there is no resource called `scene.lihgts`
  pass p13 : compute { shader "x.comp" group 8 8 1  write b as storage  dispatch over scene.lights }  //~ error[RG0314]: `scene.lights` is as long as the host makes it; its size is not known here
  pass p14 : transfer { copy b -> h.prev(1) }  //~ error[RG0309]: `h.prev(1)` belongs to an earlier frame; only `h` can be written
  pass p15 : compute { write a[0][1] as storage }  //~ error[RG0240]: `a` is declared without an index
  pass p16 : compute { write b.bytes(1.5, 2) as storage }  //~ error[RG0215]: expected a whole number
}
