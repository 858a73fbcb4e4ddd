module reads
feature fog: bool
condition missed
graph g(surface s: rgba8 4x4) {
  image a : rgba8 4x4
  image b : rgba8 4x4
  image h : rgba8 4x4 history 1 init clear 0
  image never : rgba8 4x4 history 1 init clear 0  //~ error[RG0305]: history `never` is never written
  when fog { pass p1 : compute { read never.prev(1) as sampled  write a as storage  write h as storage } }  //~ note[RG0303]: pass `p1` may leave it as it was: it is missing with `fog=off`
  if host missed { pass p2 : compute { write b as storage } }  //~ note[RG0303]: pass `p2` may leave it as it was: the host decides by `missed` whether it runs
  pass p3 : compute { read a as sampled  write s as storage }  //~ error[RG0301]: pass `p3` reads `a`, which nothing has written before
  pass p4 : compute { read b as sampled  update s as storage }  //~ error[RG0301]: pass `p4` reads `b`, which nothing has written before
  pass p5 : compute { read h.prev(1) as sampled  update s as storage }
}
