// What Vulkan's transfer commands do not take: filters, samples, blocks, odd bytes, values that do not fit.
module formats
extent n = runtime(16) max(64)
graph g(surface s: rgba8 4x4) {
  image u : r32ui 4x4
  image v : r32ui 4x4
  image z : d32f 4x4
  image w : d32f 4x4
  image f : r32f 4x4
  image m : rgba8 4x4 samples 4
  image l : rgba8 4x4 samples 4
  image a : rgba8 4x4
  image bc : bc7 4x4
  image mask : d32f_s8 4x4
  image kept : bc7 4x4 persistent init clear 0  //~ error[RG0325]: `kept` is block-compressed (`bc7`) and cannot be cleared
  image tens : rgb10a2ui 4x4
  buffer t : u32[16]
  buffer i : i32[16]
  buffer x : f32[16]
  buffer r : r32ui[16]
  buffer odd : r8ui[6]
  buffer long : u32[n]
  buffer old : u32[16] persistent init clear -1  //~ error[RG0333]: `old` holds integers (`u32`): the value for it must be whole and in range
  pass f1 : transfer { blit u -> v linear }  //~ error[RG0485]: `linear` mixes neighbours, and `u` is `r32ui`: integers are not mixed; leave `linear` out
  pass f2 : transfer { blit z -> w linear }  //~ error[RG0485]: `linear` mixes neighbours, and `z` is `d32f`: depth and stencil are not mixed; leave `linear` out
  pass f3 : transfer { blit u -> v  blit z -> w  copy m -> l }
  pass f11 : transfer { copy z -> w }
  pass f4 : transfer { blit m -> a }  //~ error[RG0486]: `blit` moves single samples, and `m` has 4; only drawing and `resolve` know several
  pass f5 : transfer { blit a -> m }  //~ error[RG0486]: `blit` moves single samples, and `m` has 4; only drawing and `resolve` know several
  pass f6 : transfer { copy m -> t }  //~ error[RG0486]: `copy` moves single samples, and `m` has 4; only drawing and `resolve` know several
  pass f7 : transfer { blit a -> bc }  //~ error[RG0325]: `bc` is block-compressed (`bc7`) and cannot be blitted to
  pass f8 : transfer { clear bc 0 }  //~ error[RG0325]: `bc` is block-compressed (`bc7`) and cannot be cleared
  pass f9 : transfer { copy z -> f }  //~ error[RG0365]: a copy needs texels of one size and sample count, depth its own format: `z` is `d32f`, `f` is `r32f`
  pass f10 : transfer { blit bc -> a linear }
  pass w1 : transfer { fill t.bytes(1, 3) 0 }  //~ error[RG0487]: `fill` takes offset and size in multiples of 4 bytes, and the range of `t` is 3 bytes from byte 1
  pass w2 : transfer { fill odd 0 }  //~ error[RG0487]: `fill` takes offset and size in multiples of 4 bytes, and the range of `odd` is 6 bytes from byte 0
  pass w3 : compute { atomic t.bytes(2, 4) as storage clear 0 }  //~ error[RG0487]: `fill` takes offset and size in multiples of 4 bytes, and the range of `t` is 4 bytes from byte 2
  pass w4 : transfer { fill odd.bytes(0, 4) 0  fill t.bytes(4, 60) 1 }
  pass v1 : transfer { fill t -1 }  //~ error[RG0333]: `t` holds integers (`u32`): the value for it must be whole and in range
  pass v2 : transfer { fill t 4294967296 }  //~ error[RG0333]: `t` holds integers (`u32`): the value for it must be whole and in range
  pass v3 : transfer { fill t 1.5 }  //~ error[RG0333]: `t` holds integers (`u32`): the value for it must be whole and in range
  pass v4 : transfer { fill i 2147483648 }  //~ error[RG0333]: `i` holds integers (`i32`): the value for it must be whole and in range
  pass v5 : transfer { fill r -1 }  //~ error[RG0333]: `r` holds integers (`r32ui`): the value for it must be whole and in range
  pass v6 : compute { atomic t as storage clear -1 }  //~ error[RG0333]: `t` holds integers (`u32`): the value for it must be whole and in range
  pass v7 : transfer { clear u 4294967296 }  //~ error[RG0333]: `u` holds integers (`r32ui`): the value for it must be whole and in range
  pass v8 : transfer { clear tens (1023, 0, 0, 4) }  //~ error[RG0333]: `tens` holds integers (`rgb10a2ui`): the value for it must be whole and in range
  pass v9 : raster { depth mask clear (1, 256) }  //~ error[RG0333]: `mask` holds integers (`d32f_s8`): the value for it must be whole and in range
  pass v10 : transfer { fill t 4294967295  fill i -2147483648  fill x -1.5  clear tens (1023, 0, 0, 3)  clear mask (1, 255) }
  pass e1 : compute { read q = t.bytes(60, 8) as storage }  //~ error[RG0488]: the byte range ends at byte 68, and `t` has 64
  pass e2 : transfer { fill t.bytes(60, 100) 0 }  //~ error[RG0488]: the byte range ends at byte 160, and `t` has 64
  pass e3 : transfer { copy t.bytes(0, 1000) -> i.bytes(0, 100) }  //~ error[RG0488]: the byte range ends at byte 1000, and `t` has 64
//~^ error[RG0488]: the byte range ends at byte 100, and `i` has 64
  pass e4 : compute { read q = long.bytes(0, 32) as storage }  //~ error[RG0488]: the byte range ends at byte 32, and `long` has 4 where `n` is 1
  pass e5 : compute { read q = long.bytes(n * 4 - 8, 8) as storage }  //~ error[RG0313]: the byte range is empty or begins before the buffer
  pass e6 : compute { read q = long.bytes(0, n * 4) as storage  read o = t.bytes(60, 4) as storage }
}
