// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct T@ght scalar { flags: r8ui  at: ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿvec3 }
graph g(surface s: rgba8 4x4 :after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { yyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyfill made 0 }
  buffer indices : u32[9] persistetn init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  read indices as module vertices
struct Vertexindexed size.x + 3 lags: r8ui  at: ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿvec3 }
graph g(surface s: rgba8 4x4 :after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { yyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyfill made 0 }
  buffer indices : u32[9] persistetn init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  read indices as module vertices
struct Vertexindexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 4 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 4 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
}
