// Transfers that would define less than they say, or leave one of their sides.
module sizes
extent view = runtime(64, 32) min(16, 16) max(128, 128)
extent n = runtime(16) max(64)
interface In { lent: buffer u32[] ready as copy_src }
graph g(engine: In, surface s: rgba8 4x4) {
  buffer x : u32[16]
  buffer y : u32[64]
  buffer whole : u32[view.width * view.height]
  buffer square : u32[view.width * view.width]
  buffer some : u32[n]
  image a : rgba8 64x64
  image seen : rgba8 view
  image halves : rgba8 view / 2
  image two : rgba8 64x64 layers 2
  image three : rgba8 64x64 layers 3
  image chain : rgba8 64x64 mips 3
  image mask : d32f_s8 64x64
  image other : d32f_s8 64x64
  image narrow : d16 64x64
  image cut : s8 5x5 mips 2 layers 2
  image volume : rgba8 16x16x4
  image flat : rgba8 16x16
  image stack : rgba8 16x16 layers 4
  image line : rgba8 [16]
  image packed : rgba32ui 3x3 mips 2
  image blocks : bc7 12x12 mips 2
  buffer texels : u32[16384]
  buffer level : u32[64 * 64 + 32 * 32 + 16 * 16]
  buffer words : u32[64 * 64]
  buffer half : u32[64 * 32]
  buffer byte : u32[1024]
  pass b1 : transfer { copy x -> y }  //~ error[RG0484]: a part of `y` would stay as it was: it is 256 bytes, and `x` is 64 bytes; name the bytes that it gets, `y.bytes(offset, size)`
  pass b2 : transfer { copy y -> x }
  pass b6 : transfer { copy x -> y.bytes(128, 64) }
  pass b3 : transfer { copy x.bytes(0, 32) -> y.bytes(0, 64) }  //~ error[RG0484]: a part of `y` would stay as it was: it is 64 bytes, and `x` is 32 bytes; name the bytes that it gets, `y.bytes(offset, size)`
  pass b4 : transfer { copy some -> x }  //~ error[RG0484]: a part of `x` would stay as it was: it is 64 bytes, and `some` is 4 bytes where `n` is 1; name the bytes that it gets, `x.bytes(offset, size)`
  pass b5 : transfer { copy y -> some }
  pass b7 : transfer { copy engine.lent -> y }
  pass c1 : transfer { copy a -> x }  //~ error[RG0489]: a copy takes 16384 bytes for `a`, tightly packed, and `x` has 64
  pass c2 : transfer { copy x -> a }  //~ error[RG0489]: a copy takes 16384 bytes for `a`, tightly packed, and `x` has 64
  pass c3 : transfer { copy a -> words  copy a -> texels.bytes(16384, 16384) }
  pass c12 : transfer { copy words -> a }
  pass c13 : transfer { copy texels -> a }
  pass c4 : transfer { copy a -> texels }  //~ error[RG0484]: a part of `texels` would stay as it was: it is 65536 bytes, and `a` is 64x64; name the bytes that it gets, `texels.bytes(offset, size)`
  pass c5 : transfer { copy seen -> whole }
  pass c14 : transfer { copy whole -> seen }
  pass c6 : transfer { copy square -> seen }  //~ error[RG0489]: a copy takes 65024 bytes for `seen`, tightly packed, and `square` has 64516 where `view` is 127x128
  pass c7 : transfer { copy chain -> level }
  pass c15 : transfer { copy level -> chain }
  pass c8 : transfer { copy chain -> words }  //~ error[RG0489]: a copy takes 21504 bytes for `chain`, tightly packed, and `words` has 16384
  pass c9 : transfer { copy narrow -> half  copy mask.stencil -> byte  copy mask.depth -> words }
  pass c10 : transfer { copy texels.bytes(2, 16384) -> a }  //~ error[RG0487]: `copy` takes an offset in multiples of 4 bytes, and the range of `texels` is 16384 bytes from byte 2
  pass c11 : transfer { copy texels.bytes(2, 8192) -> narrow }  //~ error[RG0487]: `copy` takes an offset in multiples of 4 bytes, and the range of `texels` is 8192 bytes from byte 2
  pass c16 : transfer { copy level.bytes(0, 58) -> cut }  //~ error[RG0487]: `copy` takes an offset in multiples of 4 bytes, and the range of `level` is 8 bytes from byte 50
  pass l1 : transfer { blit two -> three }  //~ error[RG0484]: a part of `three` would stay as it was: it is 64x64, 3 layers, and `two` is 64x64, 2 layers; layers are not scaled: name as many, `.layers(first, count)`
  pass l2 : transfer { blit two -> three.layers(1, 2)  blit a -> halves }
  pass l3 : transfer { copy a -> seen }  //~ error[RG0484]: a part of `seen` would stay as it was: it is 128x128, and `a` is 64x64 where `view` is 128x128; `blit` scales
  pass l4 : transfer { copy seen -> flat  copy packed.mip(0) -> blocks.mip(0) }
  pass l5 : transfer { copy packed -> blocks }  //~ error[RG0484]: a part of `blocks` would stay as it was: it is 12x12, 2 mips, and `packed` is 3x3, 2 mips; `blit` scales
  pass l6 : transfer { copy halves -> flat }  //~ error[RG0484]: a part of `flat` would stay as it was: it is 16x16, and `halves` is 64x8 where `view` is 128x16; `blit` scales
  pass a1 : transfer { copy texels -> mask }  //~ error[RG0490]: `copy` cannot tell which aspects go where: `texels` is a buffer, `mask` has depth and stencil; say `.depth` or `.stencil`
  pass a2 : transfer { copy mask.depth -> other }  //~ error[RG0490]: `copy` cannot tell which aspects go where: `mask` has depth, `other` has depth and stencil; say `.depth` or `.stencil`
  pass a3 : transfer { blit mask.depth -> other.stencil }  //~ error[RG0490]: `blit` cannot tell which aspects go where: `mask` has depth, `other` has stencil; say `.depth` or `.stencil`
  pass a4 : transfer { copy mask -> other }
  pass a5 : transfer { copy mask.stencil -> other.stencil }
  pass a6 : transfer { blit mask -> other }
  pass d1 : transfer { copy volume -> stack }  //~ error[RG0491]: `copy` takes both sides in one shape: `volume` has slices, `stack` has layers; a compute pass moves texels between them
  pass d2 : transfer { blit stack -> volume }  //~ error[RG0491]: `blit` takes both sides in one shape: `stack` has layers, `volume` has slices; a compute pass moves texels between them
  pass d3 : transfer { blit volume -> flat linear }
  pass d5 : transfer { blit stack.layer(0) -> volume }
  pass d4 : transfer { copy line -> flat }  //~ error[RG0491]: `copy` takes both sides in one shape: `line` has one axis, `flat` has two axes; a compute pass moves texels between them
}
