module names
struct Corner { at: vec3  tint: rgba8 }
struct Draw { model: u32 }
feature quality: { low, high }
interface Scene { corners: buffer Corner[] ready as vertex  bark: image rgba8 16x16 ready as sampled in fragment }

graph frame(scene: Scene, surface backbuffer: rgba8 64x64 after copy_src)
{
  pass show : raster {
    shader "a.vert" "a.frag"
    features quality
    read scene.corners as vertex
    read scene.bark as sampled
    color backbuffer clear 0
    draw host { per_draw Draw  vertex Corner }
  }
}
