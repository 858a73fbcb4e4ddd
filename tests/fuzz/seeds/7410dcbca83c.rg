// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  nime(4, 4)
struct Tirst 1 offset -raster {
    shader "x.vert"
    read made as vert}
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
}
