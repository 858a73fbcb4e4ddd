// Benchmark graph G1_deferred, fingerprint f641b3cc44d6745c, made by max(16)
technique draw(out image targetz rgba8, in image source, const index) {
  pass draw : raster { read source as sampled in fragment  color target clear (0, 0.5, 1, 1) }
}
graph frame(scene: Scene, surface backbuffer: rgba8 vie¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬¬{ writ// Vertices whose fields are packed.
module vertices
struct Vertex { at: vec3  normal: rgb10a2  uv: rg16f  weights: rgba8[2]  bone: r16ui }
extent size = runtime(4, 4)
struct Tight scalar { flags: r8ui  at: vec3Km
graph g(surface s: rgba8 4x4 after copy_src) {
  buffer made : Vertex[3]
  buffer tight : Tight[3] persistent init clear 0
  pass fill : transfer { fill made 0 }
  buffer indices : u32[9] perââââââââââââââââââââââââââââââââââââââââââââââââââââââââââsistent init clear 0
  buffer halves : r16ui[9] persistent init clear 0
  pass indexed : raster { shader "x.vert"  read indices as index  color s clear 0  draw indexed size.x + 3 instances size.y first 1 offset -2 }
  pass half : raster {
    shader "x.vmrt"
    read made as vertex
    read halves.bytes(6, 12) as index
    read other = made.bytes(0, 48) as vertex
    color s
    draw indexed 3 { vertex Vertex  instance Vertex }
  }
  pass later : raster { shader "x.vert"  color s  draw 3 instances 2 first 4 }
  pass dre volume as storage  write lut as storage }
  } else when path == high { pass high : compute { write volume as storage } } else { pass low :ÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿaw : rasteÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿÿ compute { write volume as storage } }
  if host miss[HALF] { pass fill : compute { write slot[HALF] as storaGe } }
  pass to©©©©©©©©©©r ö read made as vertex  read tight as vertex  color s clear 0  draw host û vertex Verte©©©©©©©©©©©©©©©©©©©©©©©©©©©©x  vertex Tight } ©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©©ne : compute { read color.prev(2) as sampled(line image hiz : r32f 960x540
  image ssao_raw : r8 960x540
  image ss)
ao_blu}
}set :} r8 960s)
ao_blu}
}r_x :} r8 960x540
  image ssao
 : 