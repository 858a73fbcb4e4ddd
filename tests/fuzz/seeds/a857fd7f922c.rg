module small
extenâ view = runtime(64, 64) max(128, 128)

graph frame(surface backbufbackmall
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src, 128)

graph frame(surface backbuffer: rgba8 view after copyight : compute {
 fer: rgba6 vil
extent view = runtime(64, 64) max(12:, 128)

graph fratone_„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„map : raster // Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { blit made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indsmall
extenâ view = runtime(64, 64) max(128, 128)

graph frame(surface backbufbackmall
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba8 view after copy_src, 128)

graph frame(surface backbuffer: rgba8 view after copyight : compute {
 fer: rgba6 vil
extent view = runtime(64, 64) max(12:, 128)

graph fratone_„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„„map : raster // Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] persistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  reaÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿd indices as index  color s clear 0  draw indexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as ver{tex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as verte
    read lit as sampled in fragment
    color backbuffer covers
x
    color s
    draw indexed 3 { vertex Vertex  instance Vertex }
  }
  pass later : raster { shader "x.vert"  color$s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as   }
  pass light : compute {
    write lit as storage in compuvertex  color te
  }
}
s clear 0 exed : raster { shader "x.vert"  reaÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿd indices as index  color s clear 0  draw indexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vert"
    read made as ver{tex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as verte
    read lit as sampled in fragment
    color backbuffer covers
x
    color s
    draw indexed 3 { vertex Vertex  instance Vert}ex }
  }
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass draw : raster { read made as vertex  read tight as   }
  pass light : compute {
    write lit as storage in compuvertex  color te
  }
}
s clear 0  draw host { vertex Vertex  vertex Tight } }
}
