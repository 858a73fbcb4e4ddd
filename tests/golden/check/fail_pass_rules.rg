module rules
graph g(surface s: rgba8 4x4) {
  image a : rgba8 8x8
  image b : rgba8 4x4
  image c : rgba8 8x8 samples 4
  image d : rgba8 8x8 layers 2
  image m : rgba8 8x8 mips 2
  image i0 : r8 4x4  image i1 : r8 4x4  image i2 : r8 4x4  image i3 : r8 4x4
  image i4 : r8 4x4  image i5 : r8 4x4  image i6 : r8 4x4  image i7 : r8 4x4
  buffer e : u32[16]
  pass sizes : raster { color a clear 0  color b clear 0 }  //~ error[RG0352]: `b` is 4x4, other attachments of the pass are 8x8
//~^ note[RG0355]: compared with this one
  pass samples : raster { color a clear 0  color c clear 0 }  //~ error[RG0353]: `c` has 4 samples, other attachments of the pass 1
//~^ note[RG0355]: compared with this one
  pass layers : raster { color a clear 0  color d clear 0 }  //~ error[RG0354]: `d` has 2 layers, other attachments of the pass 1
//~^ note[RG0355]: compared with this one
  pass many : raster {  //~ error[RG0351]: pass `many` has 9 colour attachments; the limit is 8
    color i0 clear 0  color i1 clear 0  color i2 clear 0  color i3 clear 0  color i4 clear 0
    color i5 clear 0  color i6 clear 0  color i7 clear 0  color s clear 0
  }
  pass conflict : compute { read a as sampled  write other = a as storage }  //~ error[RG0356]: pass `conflict` uses `a` as `sampled` and as `storage`, and one of them writes
//~^ note[RG0357]: the other access is here
  pass counts : compute { atomic one = e as storage  read two = e as storage }  //~ error[RG0356]: pass `counts` uses `e` as `atomic storage` and as `read storage`, and one of them writes
//~^ note[RG0357]: the other access is here
  pass twice : compute { write one = e.bytes(0, 32) as storage  write two = e.bytes(16, 32) as storage }  //~ error[RG0356]: pass `twice` uses `e` as `storage` and as `storage`, and one of them writes
//~^ note[RG0357]: the other access is here
  pass apart : compute { write one = e.bytes(0, 32) as storage  write two = e.bytes(32, 32) as storage }
  pass before : compute { write m.mip(0) as storage }
  pass named : compute { read m.mip(0) as sampled  write m.mip(1) as storage }  //~ error[RG0358]: a second access of the pass is called `m`; rename one: `read other = ...`
//~^ note[RG0357]: the other access is here
  buffer f : u32[4] readback
  pass told : host { write e }  //~ error[RG0300]: pass `told` runs its callback while the frame is recorded, before the GPU has done any of it, and cannot write `e`; `update` in a transfer pass takes the engine's bytes
  pass seen : host { read f }  //~ error[RG0300]: pass `seen` runs its callback while the frame is recorded, before the GPU has done any of it, and cannot read `f`; a `readback` buffer is read after the frame
}
