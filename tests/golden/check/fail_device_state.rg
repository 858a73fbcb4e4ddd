// What not every device has: a state asks for it where a feature of the pass says that the device does, and fits the attachments.
feature bounds: device depth_bounds
feature whole: device conservative_rasterization
feature placed: device sample_locations
state lit { depth bounds 0.25 0.75 }  //~ note[RG0202]: `lit` is declared here
state covering { conservative  topology lines }  //~ note[RG0202]: `covering` is declared here
state left { samples at 0.25 0.5, 0.75 0.5 }  //~ note[RG0202]: `left` is declared here
state beyond { depth bounds 0.5 1.25 }  //~ error[RG0218]: 1.25 is not between 0 and 1
state upside_down { depth bounds 0.75 0.25 }  //~ error[RG0218]: 0.25 is not between 0.75 and 1
state outside { samples at 0.5 1.5 }  //~ error[RG0218]: 1.5 is not between 0 and 1

graph frame(surface backbuffer: rgba8 64x64)
{
  image depth : d32f 64x64
  image many  : rgba8 64x64 samples 4
  pass a : raster { fullscreen "a.frag"  state lit  depth depth clear 0  color backbuffer }  //~ error[RG0510]: state `lit` needs `depth_bounds`, which profile `vulkan 1.3` does not promise; declare `feature NAME : device depth_bounds` and name it in `features` of the pass: where a device has none, the pass draws without
  pass b : raster { fullscreen "a.frag"  features bounds  state lit  color backbuffer }  //~ error[RG0735]: state `lit` does not fit pass `b`: its bounds are of a depth attachment, which the pass has not
  pass c : raster { fullscreen "a.frag"  features whole  state covering  color backbuffer }  //~ error[RG0735]: state `covering` does not fit pass `c`: only triangles are rasterised conservatively
  pass d : raster { fullscreen "a.frag"  features placed  state left  color many clear 0  keep }  //~ error[RG0735]: state `left` does not fit pass `d`: it places 2 samples, and its attachments have 4
  pass e : raster { fullscreen "a.frag"  features placed  state left  depth depth  color backbuffer }  //~ error[RG0735]: state `left` does not fit pass `e`: it places samples, and depth is kept for the device's own
  pass f : raster { fullscreen "a.frag"  features bounds  state beyond  depth depth  color backbuffer }
  pass g : raster { fullscreen "a.frag"  features bounds  state upside_down  depth depth  color backbuffer }
  pass h : raster { fullscreen "a.frag"  features placed  state outside  color backbuffer }
}
