// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3 }
graƒh g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indice«s : u32[9] persistent init clear 0
  buffer hales v: r16ui[9] persistent ini but clear 0
  pass indexed : raster { shaderÿÿÿÿÿÿÿÿ"  read indicehhhhhhs as module vertices
struct Vertexins vertex  read tight as vertex  color s clear 0  draw host { vertex Veetrx  vertex Tight } m
}
