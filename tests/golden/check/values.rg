// Folding, extents, parts, rounding.
module values
const A = (1 + 2) * 3 - 4 / 2
const B = min(A, 3, max(2, 1))
const C = ceil(7 / 2) + floor(7 / 2)
const D = ceil(1.5 * 3) - -1
const E = -7 / 2
const F = 0x10
const SIZE = [4, 5]
extent view = runtime(100, 50) max(200, 100)
extent line = runtime(7)
graph g(surface s: rgba8 4x4) {
  buffer a : u32[view.width * view.y + SIZE.area] output
  buffer b : u32[ceil(view / 8).area] output
  buffer c : u32[max(view.x / 2, 16) + min(line, 9)] output
  buffer d : u32[view.x * 1 + 0] output
  image e : r32f (view + 1) / 2 output
  image f : r32f e / 2 output
  pass p : compute { write a as storage  write b as storage  write c as storage  write d as storage  write e as storage  write f as storage  write s as storage }
}
