module small
ed : r8l
extent view = runtime(64, 64) max(128, 128)

graph frame(surface ba }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer madr: rgb view

  pass lighframe(surface ba }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[+]
  buffer tight : Tightcked.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui as storage in compute
  }

 ?pass ttaa_prev: raster {
    read lit as sampled inlinegment
    color backbuffer covers
  }
}
