// Parts that do not add up, and pixels that tests keep out.
module ranges
extent n = runtime(64) min(2) max(1000)
state masked { stencil test equal }
state near { depth test less }
graph g(surface s: rgba8 4x4 after copy_src) {
  image known : r32f 8x8x4  //~ note[RG0202]: `known` is declared here
  image third : r32f 8x8x4  //~ note[RG0202]: `third` is declared here
  image mask  : d32f_s8 4x4
  image holes : rgba8 4x4  //~ note[RG0202]: `holes` is declared here
  image seen  : rgba8 4x4  //~ note[RG0202]: `seen` is declared here
  image whole : rgba8 4x4
  buffer words : u32[n * 4]  //~ note[RG0202]: `words` is declared here
  buffer rest  : u32[n]  //~ note[RG0202]: `rest` is declared here
  buffer last  : u32[n]  //~ note[RG0202]: `last` is declared here
  pass most  : raster { color known.slices(1, 3) clear 0  draw host }
  pass some  : raster { color third.slice(2)  draw host }  //~ error[RG0390]: pass `some` keeps what it does not touch of `third`, which nothing has written before; declare `clear` or `covers`
  pass first : compute { read known as sampled }  //~ error[RG0301]: pass `first` reads `known`, which nothing has written before
//~^ note[RG0304]: mip 0, slice 0 of it has not been written
  pass mark  : raster { stencil mask clear 0  depth mask clear 0  draw host }
  pass out   : raster { state masked  fullscreen "x.frag"  stencil mask readonly  color holes }  //~ error[RG0390]: pass `out` keeps what it does not touch of `holes`, which nothing has written before; declare `clear` or `covers`
  pass far   : raster { state near  fullscreen "x.frag"  depth mask readonly  color seen }  //~ error[RG0390]: pass `far` keeps what it does not touch of `seen`, which nothing has written before; declare `clear` or `covers`
  pass all   : raster { state near  fullscreen "x.frag"  color whole }
  for i in 0..3 { pass quarter[i] : compute { write words.bytes(i * n * 4, n * 4) as storage } }
  pass add   : compute { read words as storage }  //~ error[RG0301]: pass `add` reads `words`, which nothing has written before
//~^ note[RG0304]: a part of it has not been written
  pass front : compute { write rest.bytes(0, n / 3 * 4) as storage }
  pass back  : compute { write rest.bytes(n / 2 * 4, (n - n / 2) * 4) as storage }
  pass sum   : compute { read rest as storage }  //~ error[RG0301]: pass `sum` reads `rest`, which nothing has written before
//~^ note[RG0304]: a part of it has not been written
  pass begin : compute { write last.bytes(0, n * 2) as storage }
  pass end   : compute { write last.bytes(n * 2, n * 2 - 4) as storage }
  pass tail  : compute { read part = last.bytes(n * 4 - 4, 4) as storage }  //~ error[RG0301]: pass `tail` reads `last`, which nothing has written before
//~^ note[RG0304]: a part of it has not been written
  pass show  : raster { color s clear 0  draw host }
}
