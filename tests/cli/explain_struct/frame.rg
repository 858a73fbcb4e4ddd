module small
struct Sun { to: vec3  strength: f32 }
struct View { world_to_clip: mat4  sun: Sun  turn: mat3  weights: f32[3]  count: u32 }
graph frame(params camera: View, surface backbuffer: rgba8 64x64 after copy_src)
{
  pass show : raster { params camera  color backbuffer clear 0  draw host { per_draw Sun } }
}
