module resources
target vulkan 1.1  //~ error[RG0009]: the targets are `vulkan 1.3` and `vulkan 1.4`, not 1.1
graph g(surface s: rgba8 4x4) {
  image a : rgba7 4x4  //~ error[RG0244]: there is no format called `rgba7`
//~^ note[RG0605]: did you mean `rgba8`?
  image b : rgba8 [0, 4]  //~ error[RG0315]: image `b` is 0 texels along an axis; the limits are 1 and 65536
  image c : rgba8 70000x4  //~ error[RG0315]: image `c` is 70000 texels along an axis; the limits are 1 and 65536
  image d : rgba8 4x4 3d  //~ error[RG0319]: image `d` has 3 axes by its dimension, 2 by its size
  image e : rgba8 4x4 mips 4  //~ error[RG0320]: image `e` declares 4 mips; 4 texels have 3
  image f : rgba8 4x4 samples 3  //~ error[RG0321]: 3 samples are not a power of two
  image h : rgba8 4x4 samples 4 mips 2  //~ error[RG0322]: image `h` has several samples: it must be two-dimensional with one mip
  image i : rgba8 [4, 4, 4] layers 2  //~ error[RG0323]: image `i` is three-dimensional and cannot have layers
  image j : d32f [4, 4, 4]  //~ error[RG0324]: image `j` is three-dimensional and cannot be of format `d32f`
  image k : bc1 4x4 samples 4  //~ error[RG0325]: `k` is block-compressed (`bc1`) and cannot have several samples
  image l : rgba8 4x4 readback  //~ error[RG0327]: image `l` cannot be read back; copy it to a buffer that is
  image m : rgba8 4x4 history 1 persistent  //~ error[RG0328]: `m` has two lifetimes
  image n : rgba8 4x4 ready as sampled  //~ error[RG0329]: `n` is not brought by the engine: it has no state before or after the graph
  image o : rgba8 4x4 init clear 0  //~ error[RG0330]: `o` does not outlive the frame: `init` needs `history` or `persistent`
  image p : rgba8 4x4 history 1  //~ error[RG0306]: history `p` needs `init clear VALUE`: the first frame has no previous one
  image q : rgba8 4x4 mips 1 mips 2  //~ error[RG0117]: `mips` is set twice
//~^ note[RG0118]: the first is here
  image r : rgba8 4x4 layers 0  //~ error[RG0218]: 0 is not between 1 and 2048
  buffer t : u32[0]  //~ error[RG0316]: buffer `t` has 0 elements; the limits are 1 and 4294967295
  buffer u : u32  //~ error[RG0317]: buffer `u` needs a length: `T[n]`
  buffer v : u32[]  //~ error[RG0318]: buffer `v` needs a length: only what the engine brings may leave it open
  buffer w : u32[4] mips 2  //~ error[RG0326]: `mips` is a setting of images
  buffer x : Missing[4]  //~ error[RG0209]: there is no type called `Missing`
  image y : rgba8ui 4x4 persistent init clear 0.5  //~ error[RG0333]: `y` holds integers (`rgba8ui`): the value for it must be whole and in range
  image z : rgba8 4x4 persistent init clear (0, 0, 0, 0, 0)  //~ error[RG0332]: `z` takes up to 4 clear components, not 5
  image zz : d32f 4x4 persistent init clear 2  //~ error[RG0334]: `zz` holds depths: its clear value must be between 0 and 1
}
