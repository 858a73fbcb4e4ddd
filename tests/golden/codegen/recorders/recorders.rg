// Everything the typed API has a word for.
module recorders

const LIGHTS = 16
extent view = runtime(64, 32) max(256, 256)
extent shadow_size = runtime(128) max(1024)

struct Sun { direction: vec3  intensity: f32 }
struct View { world_to_clip: mat4  camera: vec3  sun: Sun  weights: f32[3] }
struct Blur { radius: f32 }
struct Draw { model: u32  tint: vec4 }
struct Vertex { position: vec3  texcoord: rg16f  tint: rgba8 }
struct Light { position: vec3  color: vec3  suns: Sun[2] }

interface Scene {
  lights:   buffer Light[] ready as storage in fragment
  vertices: buffer Vertex[] ready as vertex
  spare:    buffer u32[] ready as storage in compute  // which no pass uses
}
sampler smooth { filter linear  address clamp }
state   solid { cull back  depth test greater_equal }
set     materials 0 { uniform sampler2D albedo_map; }
condition cached

graph frame(params view_constants: View, scene: Scene, surface backbuffer: rgba8 view after copy_src)
{
  image  depth   : d32f view
  image  color   : rgba16f view history 1 init clear 0
  image  bloom   : rgba16f view / 2 mips 3
  buffer table   : u32[64]
  buffer counted : u32[4] readback

  pass fill_table : transfer {
    update table
  }
  pass meshes : raster {
    shader "meshes.vert" "meshes.frag"
    state  solid
    params view_constants
    bind   materials
    read   scene.vertices as vertex
    read   scene.lights as storage
    read   table as storage
    color  color clear 0
    depth  depth clear 0.0
    draw   host { per_draw Draw  vertex Vertex }
  }
  pass own_pipelines : raster {
    color  color
    depth  depth readonly
    draw   host { per_draw Draw }
  }
  pass bloom_first : compute {
    shader "first.comp" group 8 8 1
    read   color as sampled(smooth)
    write  target = bloom.mip(0) as storage
    dispatch over bloom
  }
  for mip in 1..mips(bloom) {
    pass bloom_down[mip] : compute {
      shader "down.comp" group 8 8 1
      params blur: Blur
      read   source = bloom.mip(mip - 1) as sampled(smooth)
      write  target = bloom.mip(mip) as storage
      dispatch over bloom.mip(mip)
    }
  }
  if host cached {
    pass count : compute {
      shader "count.comp" group 64 1 1
      read   depth as sampled
      atomic counted as storage clear 0
      dispatch over view
    }
  }
  pass show : raster {
    fullscreen "show.frag"
    read   color as sampled(smooth)
    read   color.prev(1) as sampled(smooth)
    read   bloom as sampled(smooth)
    color  backbuffer
  }
}
