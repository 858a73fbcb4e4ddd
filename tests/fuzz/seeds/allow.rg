allow RG0516
module allowing
graph g(surface s: rgba8 4x4) {
  allow RG0388
  buffer unused : u32[4] { allow RG0388 }
  when on { pass p : compute { allow RG0516  write unused as storage } }
  pass show : raster { color s clear 0  draw host }
}
