module variants
extent view = runtime(64, 64) max(64, 64)
feature fog : bool
spectrum empty { modes 4 }  //~ error[RG0702]: spectrum `empty` has 0 features; it takes one to 32
spectrum kinds { a  b requires a, nobody  modes 40 }  //~ error[RG0203]: there is no feature of spectrum `kinds` called `nobody`
//~^ error[RG0218]: 40 is not between 1 and 32
spectrum twice { a  a  profile "../x.json" }  //~ error[RG0201]: `a` is declared twice
//~^ error[RG0706]: cannot read profile `../x.json`: it is outside the folder of the root file
//~^^ note[RG0202]: `a` is declared here
graph g(surface s: rgba8 view) {
  buffer masks : u32[64]
  buffer pairs : uvec2[64]
  buffer out   : u32[64]
  pass p1 : transfer { features fog  fill out 0 }  //~ error[RG0701]: pass `p1` has no shaders that could depend on features
  pass p2 : compute { write masks as storage  write pairs as storage }
  pass p3 : compute { shader "x.comp" group 8 8 1  spectrum kinds by pairs  write s as storage  dispatch over view }  //~ error[RG0703]: `pairs` cannot hold the masks of spectrum `kinds`: they take a buffer of u32, one element a group
  pass p4 : compute { shader "x.comp" group 8 8 1  spectrum kinds by masks  write s as storage  dispatch over view }  //~ error[RG0705]: the kernels of spectrum `kinds` write `s` at the same time; declare it `disjoint`
  pass p5 : compute { spectrum kinds by masks  update s as storage disjoint  dispatch host }  //~ error[RG0704]: pass `p5` cannot run spectrum `kinds`: that takes a compute pass with a shader and `dispatch over` or `dispatch groups`
  pass p6 : compute { shader "x.comp" group 8 8 1  features fog, fog, mist  write s as storage  dispatch over view }  //~ error[RG0201]: `fog` is declared twice
//~^ error[RG0203]: there is no feature called `mist`
//~^^ note[RG0202]: `fog` is declared here
  pass p7 : compute { shader "x.comp" group 8 8 1  spectrum others by masks  write s as storage disjoint  dispatch over view }  //~ error[RG0203]: there is no spectrum called `others`
  pass p8 : compute { shader "x.comp" group 8 8 1  spectrum kinds by masks into pairs  write s as storage disjoint  dispatch over view }  //~ error[RG0719]: `pairs` cannot show the kernels of spectrum `kinds`: that takes an image of r32ui, one texel a group
}
feature warp : device subgroups  //~ error[RG0203]: there is no capability of devices called `subgroups`
