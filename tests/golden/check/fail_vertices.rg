// What vertices cannot be made of, and where packed ones cannot be.
module vertices
struct Vertex { at: vec3  tint: rgba8 }  //~ note[RG0202]: `tint` is declared here
struct Bad { tint: rgba8_srgb }  //~ error[RG0392]: no field can be of format `rgba8_srgb`: not every device reads vertices of it
struct Outer { inner: Vertex }  //~ error[RG0393]: struct `Vertex` packs `tint` as `rgba8`, which only vertices can; shaders see blocks in plain types
struct Plain { at: vec3 }
interface Mesh { texels: buffer r16ui[]  ready as index }  //~ note[RG0202]: `mesh.texels` is declared here
graph g(params vertex: Vertex, mesh: Mesh, surface s: rgba8 4x4 after copy_src) {  //~ error[RG0393]: struct `Vertex` packs `tint` as `rgba8`, which only vertices can; shaders see blocks in plain types
  buffer made : Vertex[3]  //~ note[RG0202]: `made` is declared here
  buffer numbers : f32[12] persistent init clear 0  //~ note[RG0202]: `numbers` is declared here
  pass make : compute { write made as storage }  //~ error[RG0393]: struct `Vertex` packs `tint` as `rgba8`, which only vertices can; shaders see blocks in plain types
  pass draw : raster { color s clear 0  draw host { per_draw Vertex  vertex Vertex } }  //~ error[RG0393]: struct `Vertex` packs `tint` as `rgba8`, which only vertices can; shaders see blocks in plain types
  pass none : raster { shader "x.vert"  color s clear 0  draw 3 { vertex Plain  instance Plain } }  //~ error[RG0394]: pass `none` draws 2 vertex structs and reads 0 buffers as `vertex`: each struct takes one, in order
  pass other : raster { shader "x.vert"  read made as vertex  color s clear 0  draw 3 { vertex Plain } }  //~ error[RG0395]: `made` holds `Vertex`, and the draw takes vertices of `Plain` from it
  pass bytes : raster { shader "x.vert"  read numbers as vertex  color s clear 0  draw indexed 3 { vertex Plain } }  //~ error[RG0396]: pass `bytes` draws indexed and reads no buffer as `index`: it takes one
  pass floats : raster { shader "x.vert"  read numbers as index  color s clear 0  draw indexed 3 }  //~ error[RG0397]: `numbers` holds `f32`; indices are `u32` or `r16ui`
  pass texel : raster { shader "x.vert"  read mesh.texels as sampled in vertex  color s clear 0  draw 3 }  //~ error[RG0391]: buffer `mesh.texels` cannot hold texels of `r16ui`: shaders see what the engine brings through a copy
  pass rest : raster { shader "x.vert"  color s clear 0  draw 3 offset 1 }  //~ error[RG0113]: `offset` is no option here
}
