// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  e : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  read indices as module vertices
struct Vertexindexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shadex "x.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Veetrx  vertex Tight } }
}
