// Bundles, families of several indices, named instances in loops, input attachments, scalar structs, structs that stand in a pass.
module bundles

extent view = runtime(64, 64) max(128, 128)
struct Particle scalar { at: vec3  turn: mat3  ages: f32[3] }

technique fade(image source, inout image target) {
  bundle both {
    read   source as sampled
    update target as storage
  }
  pass fade : compute { with both }
}

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image  cubes     : d16 64x64 cube layers 2
  image  slices    : rgba8 [view / 4, 16]
  image  eyes      : rgba8 view layers 2
  image  depth     : d32f view samples 4
  image  near      : d32f view
  buffer particles : Particle[64]
  buffer hits      : u32[4]

  bundle drawn { draw host { per_draw Draw } }
  pass move : compute { write particles as storage  write slices as storage }
  for lamp in 0..2 {
    for face in 0..6 {
      pass shadow[lamp][face] : raster { with drawn  depth cubes.layer(lamp * 6 + face) clear 0 }
    }
  }
  pass first  : raster { depth depth clear 0  resolve depth -> near  draw host { per_draw Draw { model: u32 } } }
  pass stereo : raster { color eyes clear 0  atomic hits in vertex, fragment clear 0 }
  for i in 0..2 {
    image soft[i] : rgba8 view
    pass start[i] : transfer { clear soft[i] 0 }
    use left[i] = fade(slices, inout soft[i])
  }
  pass show : raster {
    read  soft[1] as input
    read  near as input
    read  cubes as sampled in fragment
    read  eyes as sampled in fragment
    read  particles as storage in vertex
    read  hits as storage in fragment
    color backbuffer clear 0
  }
  assert live(shadow[1][5])
  assert overlaps(start[0], start[1]) on one_queue
}
