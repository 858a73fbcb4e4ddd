// What only some devices can: pipelines for those that do and for those that do not, in one plan each.
module devices
feature bounds: device depth_bounds
feature whole: device conservative_rasterization
feature corners: device barycentrics
feature placed: device sample_locations
state lit { cull none  depth bounds 0.25 0.75 }
state covering { cull none  conservative }
state left { cull none  samples at 0.25 0.125, 0.25 0.375, 0.25 0.625, 0.25 0.875 }

graph frame(surface backbuffer: rgba8 64x64 after copy_src)
{
  image depth : d32f 64x64
  image many  : rgba8 64x64 samples 4
  image one   : rgba8 64x64
  pass light : raster {
    fullscreen "white.frag"
    features   bounds
    state      lit
    depth      depth clear 0.5
    color      out_color = backbuffer clear 0
  }
  pass cover : raster {
    shader   "corners.vert" "corners.frag"
    features whole, corners
    state    covering
    color    out_color = backbuffer
    draw     3
  }
  pass edges : raster {
    shader   "corners.vert" "white.frag"
    features placed
    state    left
    color    out_color = many clear 0
    resolve  many -> one
    draw     3
    keep
  }
}
