// Attachments that cannot be.
module targets
extent deep = runtime(8) min(4) max(64)
extent lots = runtime(12) min(8) max(16)
extent few  = runtime(2) min(1) max(6)
state masked { stencil test equal  stencil reference 300  stencil pass copy  stencil pass keep }  //~ error[RG0117]: `stencil pass` is set twice
//~^ error[RG0218]: 300 is not between 0 and 255
//~^^ error[RG0229]: `copy` is no value of `stencil`; known are `keep`, `zero`, `replace`, `increment`, `decrement`, `invert`, `increment_wrap`, `decrement_wrap`
//~^^^ note[RG0118]: the first is here
//~^^^^ note[RG0202]: `masked` is declared here
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4 mips 2
  image open  : r32f [8, 8, deep]  //~ note[RG0202]: `open` is declared here
  image mask  : d32f_s8 4x4  //~ note[RG0202]: `mask` is declared here
  image many  : rgba8 4x4 layers 7
  pass whole : raster { color open clear 0  draw host }  //~ error[RG0399]: `open` is as deep as the host makes it: an attachment takes slices of it, `open.slice(z)`
  pass far   : raster { color open.slice(4) clear 0  draw host }  //~ error[RG0311]: `open` has 4 slices; 4 is not among them
  image less : r32f [8, 8, lots - few]
  pass two   : raster { color less.slice(1) clear 0  draw host }
  pass three : raster { color less.slice(2) clear 0  draw host }  //~ error[RG0311]: `less` has 2 slices; 2 is not among them
  pass flat  : raster { color s.slice(0) clear 0  draw host }  //~ error[RG0312]: `s` is no 3D image, which has no `slice`
  pass small : raster { color known.slice(3).mip(1) clear 0  draw host }  //~ error[RG0311]: `known` has 2 slices; 3 is not among them
  pass start : transfer { clear known 0 }
  pass read  : compute { read known.slice(1) as sampled }  //~ error[RG0340]: `slice` does not go with `sampled`
  pass depth : raster { depth mask.view(d32f) clear 0  draw host }  //~ error[RG0255]: `mask` is `d32f_s8`, which cannot be seen as `d32f`: depth and stencil have one format each
  pass seven : raster { multiview  color many clear 0  draw host }  //~ error[RG0256]: pass `seven` cannot have several views: not every device has more than six
  pass none  : raster { multiview  draw host }  //~ error[RG0256]: pass `none` cannot have several views: views are layers of attachments, and it has none
  pass deep  : raster { multiview  color known.mip(0) clear 0  draw host }  //~ error[RG0256]: pass `deep` cannot have several views: slices of volumes are no views
  pass fast  : compute { multiview  write many as storage }  //~ error[RG0256]: pass `fast` cannot have several views: it is no raster pass
  pass test  : raster { state masked  color s clear 0  draw host }  //~ error[RG0398]: pass `test` tests stencil by state `masked` and has no stencil attachment
}
