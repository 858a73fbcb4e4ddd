// A draw that the plan records: its buffers, stencil, several views.
module drawing
extent view = runtime(64, 32) max(256, 256)
struct Vertex { position: vec3  texcoord: rg16f  tint: rgba8 }
interface Scene { vertices: buffer Vertex[] ready as vertex  places: buffer f32[64] ready as vertex }
struct Place { place: vec2 }
state marked { depth test less  stencil pass replace  stencil reference 1  stencil_back pass increment_wrap  stencil_back write_mask 15 }

graph frame(scene: Scene, surface backbuffer: rgba8_srgb view after copy_src)
{
  image  mask    : d32f_s8 view layers 2
  image  fog     : r32ui 16x16x8
  buffer indices : r16ui[64] persistent init clear 0
  pass marks : raster {
    multiview
    shader "marks.vert" "marks.frag"
    state  marked
    read   scene.vertices as vertex
    read   scene.places.bytes(64, 128) as vertex
    read   indices.bytes(32, 64) as index
    depth  mask clear 1
    stencil mask clear 0
    draw   indexed 6 instances view.x first 3 offset 1 { vertex Vertex  instance Place }
    keep
  }
  pass slices : raster { color fog.slices(2, 3).view(rgba8) clear (0, 0, 0, 1)  draw host  keep }
  pass show   : raster { fullscreen "show.frag"  color linear = backbuffer.view(rgba8) }
}
