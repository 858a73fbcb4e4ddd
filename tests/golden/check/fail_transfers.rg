module transfers
graph g(surface s: rgba8 4x4) {
  image a : rgba8 4x4  //~ note[RG0202]: `a` is declared here
  image b : rgba16f 4x4
  image m : rgba8 4x4 samples 4
  image n : r32f 4x4
  buffer c : u32[16]  //~ note[RG0202]: `c` is declared here
  pass p1 : transfer { clear c 0 }  //~ error[RG0359]: `clear` cannot work on a buffer, and `c` is one
  pass p2 : transfer { fill a 0 }  //~ error[RG0359]: `fill` cannot work on an image, and `a` is one
  pass p3 : compute { copy a -> b }  //~ error[RG0360]: `copy` belongs in a transfer pass
  pass p4 : transfer { copy a -> a }  //~ error[RG0361]: `a` is source and destination at once
  pass p5 : transfer { copy a -> b }  //~ error[RG0365]: a copy needs texels of one size and sample count, depth its own format: `a` is `rgba8`, `b` is `rgba16f`
  pass p6 : transfer { resolve a -> s }  //~ error[RG0362]: a resolve goes from several samples to one: `a` has 1, `s` has 1
  pass p7 : transfer { resolve m -> n }  //~ error[RG0363]: a resolve keeps the format: `m` is `rgba8`, `n` is `r32f`
  pass p8 : raster { color s clear 0  resolve m -> s }  //~ error[RG0364]: `m` is no colour attachment of pass `p8`
  pass p9 : raster { host { read a as copy_src } }  //~ error[RG0360]: `host` belongs in a transfer pass
  image u : r32ui 4x4
  image i : r32i 4x4
  image z : d32f 4x4
  pass p10 : transfer { blit a -> u }  //~ error[RG0482]: a blit keeps whole numbers whole, with or without a sign, and depth as it is: `a` is `rgba8`, `u` is `r32ui`
  pass p11 : transfer { blit u -> i }  //~ error[RG0482]: a blit keeps whole numbers whole, with or without a sign, and depth as it is: `u` is `r32ui`, `i` is `r32i`
  pass p12 : transfer { blit z -> n }  //~ error[RG0482]: a blit keeps whole numbers whole, with or without a sign, and depth as it is: `z` is `d32f`, `n` is `r32f`
  pass p13 : transfer { blit a -> n }
  image large : rgba8 8x4
  image stack : rgba8 4x4 layers 2
  image words : rgba32ui 2x2
  image blocks : bc7 8x8
  image deep : d32f 4x4 samples 4
  image cut : rgba8 8x4 samples 4
  pass p14 : transfer { copy a -> large }  //~ error[RG0484]: a part of `large` would stay as it was: it is 8x4, and `a` is 4x4; `blit` scales
  pass p15 : transfer { copy large -> a }
  pass p16 : transfer { copy a -> stack }  //~ error[RG0484]: a part of `stack` would stay as it was: it is 4x4, 2 layers, and `a` is 4x4; `blit` scales
  pass p17 : transfer { copy words -> blocks }
  pass p18 : transfer { copy blocks -> words }
  pass p19 : transfer { resolve deep -> z }  //~ error[RG0483]: a transfer pass resolves colour alone, and `deep` is `d32f`; say `resolve deep -> z` in the raster pass that draws `deep`
  pass p20 : transfer { resolve m -> large }  //~ error[RG0484]: a part of `large` would stay as it was: it is 8x4, and `m` is 4x4; a resolve keeps the size
  pass p21 : transfer { resolve cut -> s }
}
