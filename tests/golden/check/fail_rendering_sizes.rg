// What stands beside the attachments of a rendering has their size.
module beside
extent view = runtime(64, 64) max(128, 128)
graph g(surface s: rgba8 8x8) {
  image a : rgba8 8x8 samples 4
  image flat : rgba8 8x8
  image small : rgba8 4x4
  image large : rgba8 16x16
  image shade : d32f_s8 8x8 samples 4
  image mask : d32f_s8 8x8
  image shown : rgba8 view
  image up : rgba8 ceil(view / 2)
  image down : rgba8 view / 2
  pass r1 : raster { color a clear 0  resolve a -> flat  read flat as input }  //~ error[RG0356]: pass `r1` uses `flat` as `resolve_dst` and as `input`, and one of them writes
//~^ note[RG0357]: the other access is here
  pass r2 : raster { color a clear 0  resolve a -> small }  //~ error[RG0352]: `small` is 4x4, other attachments of the pass are 8x8
//~^ note[RG0355]: compared with this one
  pass r3 : raster { color a clear 0  resolve a -> large }  //~ error[RG0484]: a part of `large` would stay as it was: it is 16x16, and `a` is 8x8; a resolve keeps the size
  pass r4 : raster { read small as input  color s clear 0 }  //~ error[RG0352]: `small` is 4x4, other attachments of the pass are 8x8
//~^ note[RG0355]: compared with this one
  pass r5 : raster { color s clear 0  read large as input }  //~ error[RG0352]: `large` is 16x16, other attachments of the pass are 8x8
//~^ note[RG0355]: compared with this one
  pass r6 : raster { color s clear 0  read shown as input }  //~ error[RG0352]: `shown` is 64x64, other attachments of the pass are 8x8
//~^ note[RG0355]: compared with this one
  pass r8 : raster { color up clear 0  read down as input }  //~ error[RG0352]: `down` is 64x63, other attachments of the pass are 64x64
//~^ note[RG0355]: compared with this one
  pass r9 : raster { depth shade.depth clear 1  resolve shade -> mask }  //~ error[RG0492]: a rendering resolves colour or depth, not stencil, and `shade` is `d32f_s8`; say `resolve shade.depth -> mask.depth`
  pass r10 : raster { depth shade.depth clear 1  resolve shade.depth -> mask.depth }
  pass r7 : raster { color s clear 0  read flat as input }
}
