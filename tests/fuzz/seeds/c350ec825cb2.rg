// Vertices whose fields are packed.
module vertices
struct Verte { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(8, 4)
struct Tight scalaÿÿÿÿÿÿùas size.y firss 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vertex
   later : zaster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Ti‹ht } }
}
