// Conditions with an index, extents under their minimum, names another module keeps to itself, views that do not fit.
module conditions

import "conditions/parts.rg"

extent view = runtime(8, 8) min(16, 16) max(64, 64)  //~ error[RG0249]: extent `view` starts at 8, under its minimum of 16
//~^ note[RG0228]: the minimum is here
extent cells = runtime(4) min(1, 1)  //~ error[RG0226]: extent `cells` has 1 axes, its minimum 2; it takes one to three
condition refresh  //~ note[RG0202]: `refresh` is declared here
condition miss[2]  //~ note[RG0202]: `miss` is declared here
condition many[70]  //~ error[RG0218]: 70 is not between 1 and 64
condition more[63]  //~ error[RG0250]: `more` would be the 65th condition of the host; the limit is 64

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image a : rgba8 64x64  //~ note[RG0202]: `a` is declared here
  image b : r8 64x64
  image d : d32f 64x64  //~ note[RG0202]: `d` is declared here
  buffer p : Pair[4]  //~ error[RG0251]: `Pair` is private to module `parts`
  buffer q : u32[WEIGHT_BYTES]  //~ error[RG0251]: `WEIGHT_BYTES` is private to module `parts`
  buffer r : parts.Pair[4]  //~ error[RG0251]: `Pair` is private to module `parts`
  buffer s : u32[parts.WEIGHT_BYTES]  //~ error[RG0251]: `WEIGHT_BYTES` is private to module `parts`

  if host refresh[1] {  //~ error[RG0240]: `refresh` is declared without an index
    pass one : compute { write a as storage }
  }
  if host miss {  //~ error[RG0239]: `miss` is declared with an index: say which one
    pass two : compute { write a as storage }
  }
  if host miss[2] {  //~ error[RG0241]: `miss` has no element 2
    pass three : compute { write a as storage }
  }
  pass four : compute {
    write a.view(r8) as storage  //~ error[RG0255]: `a` is `rgba8`, which cannot be seen as `r8`: the texels are not of one size
    write d.view(r32f) as storage  //~ error[RG0255]: `d` is `d32f`, which cannot be seen as `r32f`: depth and stencil have one format each
    write b.view(r8_unknown) as storage  //~ error[RG0244]: there is no format called `r8_unknown`
  }
  pass five : transfer { copy a.view(rgba8_srgb) -> b }  //~ error[RG0365]: a copy needs texels of one size and sample count, depth its own format: `a` is `rgba8`, `b` is `r8`
  pass show : raster { color backbuffer clear 0 }
}
