// Histories that some frame does not write are carried forward; views through other formats; ports; conditions and names.
module history

import "history/parts.rg"

extent view = runtime(64, 64) min(16, 16) max(128, 128)
extent slices = runtime(4) max(16)
condition refresh
condition cache_miss[3]
feature taa: bool

technique sharpen(in image source: rgba8, out image target: rgba8, buffer weights: f32) {
  image half : rgba8 source / 2
  pass shrink : compute {
    read  source as sampled
    read  weights as storage
    write half as storage
  }
  pass grow : compute {
    read  half as sampled
    write target as storage
  }
}

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image  color  : rgba8 view history 1 init clear 0
  image  always : rgba8_srgb view history 2 init clear 0 layout general
  buffer state  : u32[8] history 1 init clear 0
  buffer gauss  : f32[WEIGHTS + 9 % 4]
  image  sharp  : rgba8 view
  image  slot[0] : r8 64x64 persistent init clear 0
  image  slot[1] : r8 64x64 persistent init clear 0
  image  slot[2] : r8 64x64 persistent init clear 0

  pass weigh : compute { write gauss as storage }
  when taa {
    pass accumulate : compute {
      read  color.prev(1) as sampled
      write color as storage
    }
  }
  if host refresh {
    pass count : compute { write state as storage }
  }
  pass look : compute {
    read  state as storage
    write always.view(rgba8) as storage
  }
  for i in 0..3 {
    if host cache_miss[i] {
      pass fill[i] : compute { write slot[i] as storage }
    }
  }
  use sharpen(color, sharp, gauss)
  pass show : raster {
    read  sharp as sampled
    read  seen = always.view(rgba8) as sampled
    read  oldest = always.prev(2) as sampled
    color backbuffer clear 0
  }
}
