// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(8) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test less  stencil_back test equal  stencil reference 5  stencil pass replatest  depth bot : transfer { clear open 0 }
  pass some  : raÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿster { color open.slices(0, 3) clear 2  draw hffer words : u32[n * 4]
  buferre fst  : u32[n]
  for z in 0..4 { pass deep[z] : rasters views : raster { multiview  color eyes clear 0  draw host }
  pass tests : raster { state test  depth both clear 1  stencil both clear 0  draw host }
  for i in 0..4 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) asread flat as sampled  read both.dster {
epth as sampled  read eyes as sampled }
  pass add   : compute { read wo    color backbuffer covers
  }
}rds as storage  read rest as storage  read last = words.bytes(n * 
4, n * 8) as storage }
  pass show  : raster { color s c as storage }
  pass show  : raster { color s clear 0  draw host }
}
