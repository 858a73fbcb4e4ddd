// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg32f  weights: rgba8[2]  bone: r16ui }
exte`t size = runtime(4, 4)
struct Tight scalar { flags: r8þÿÿÿÿÿÿvec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[2] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass inVertex  instance Vertex }
  }
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
}
