module reads
graph g(surface s: rgba8 4x4) {
  image never : rgba8 4x4  //~ note[RG0202]: `never` is declared here
  image late : rgba8 4x4  //~ note[RG0202]: `late` is declared here
  image holes : rgba8 4x4  //~ note[RG0202]: `holes` is declared here
  image levels : rgba8 4x4 mips 3  //~ note[RG0202]: `levels` is declared here
  buffer counted : u32[4]  //~ note[RG0202]: `counted` is declared here
  buffer args : u32[4]
  buffer bytes : u32[16]  //~ note[RG0202]: `bytes` is declared here
  pass p1 : compute { read never as sampled  write s as storage }  //~ error[RG0301]: pass `p1` reads `never`, which nothing has written before
  pass p2 : compute { read late as sampled  update s as storage }  //~ error[RG0301]: pass `p2` reads `late`, which nothing has written before
  pass p3 : compute { write late as storage }  //~ note[RG0302]: pass `p3` writes it after the read
  pass p4 : raster { color holes }  //~ error[RG0390]: pass `p4` keeps what it does not touch of `holes`, which nothing has written before; declare `clear` or `covers`
  pass p5 : compute { write levels.mip(0) as storage }
  pass p6 : compute { write levels.mip(2) as storage }
  pass p7 : compute { read levels as sampled  update s as storage }  //~ error[RG0301]: pass `p7` reads `levels`, which nothing has written before
//~^ note[RG0304]: mip 1, layer 0 of it has not been written
  pass p8 : transfer { fill args 1  fill bytes.bytes(0, 32) 0 }
  pass p9 : compute { shader "x.comp" group 8 8 1  write counted as storage  dispatch indirect args }  //~ error[RG0390]: pass `p9` keeps what it does not touch of `counted`, which nothing has written before; declare `clear` or `covers`
  pass p10 : compute { read bytes as storage  update s as storage }  //~ error[RG0301]: pass `p10` reads `bytes`, which nothing has written before
//~^ note[RG0304]: a part of it has not been written
}
