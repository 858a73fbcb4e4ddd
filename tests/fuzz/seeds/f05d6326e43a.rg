// Vertices whose fields are packed.
module vertices
struct Vertex { at: vMec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  read indices as index  color s clear 0  draw indexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as vertex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as vertex
    color s
    draw indexed 3 { vertex Vertex  instance Vertex }
  }
  pass later : raster { shader "x.ve“‹İßßœ“or s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read t@ight as vertex  color s clear 0  draw host { vertex Vertex  vertex Tight } }
}
