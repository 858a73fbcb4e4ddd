// The small frame that the other rooms test with: one of everything common.
module small
const TILE = 8
const HALF = TILE / 2
const SCALE = 1.5
extent view = runtime(64, 48) max(128, 96)
struct View { world_to_clip: mat4  camera: vec3  exposure: f32  weights: vec4[4] }
struct Light { position: vec3  range: f32 }
struct Vertex { position: vec3  normal: vec3 }
interface Scene {
  lights: buffer Light[] ready as storage in compute, fragment
  maps: image rgba8_srgb 256x256 layers 4 mips 9 ready as sampled in fragment
  grown: buffer Light[64] written as storage in compute after storage in fragment
}
sampler clamp { filter linear  mip linear  address clamp }
sampler shadow { filter linear  compare greater_equal }
state opaque { cull back  depth test greater_equal }
graph frame(params view_constants: View, scene: Scene, surface backbuffer: rgba8 view after copy_src) {
  image depth : d32f_s8 view
  image hdr : rgba16f view
  image color : rgba16f view history 1 init clear 0
  image bloom : rgba16f view / 2 mips 4
  image volume : rgba16f [16, 9, 64]
  image faces : r32f 64x64 cube
  image table : r32f 256
  buffer tiles : u32[ceil(view / TILE).area * HALF]
  buffer counts : u32[4] readback
  image cache : d16 64x64 layers 2 persistent init clear 1.0
  pass prepass : raster {
    depth depth clear 0.0
    stencil depth clear 3
    draw host { per_draw Draw { model: u32 }  vertex Vertex }
  }
  pass cull : compute queue compute may {
    shader "cull.comp" group 8 8 1
    params view_constants
    read scene.lights as storage
    read depth as sampled
    atomic tiles as storage clear 0
    atomic counts as storage clear 7
    dispatch over ceil(view / TILE)
  }
  pass shade : raster {
    shader "shade.vert" "shade.frag"
    state opaque
    params own: View
    read tiles as storage
    read scene.maps as sampled(clamp)
    read cache as sampled(shadow)
    color hdr clear (0, 0.5, 1, 0)
    depth depth readonly
    draw 3 instances 2
  }
  pass glow : raster {
    color hdr blend add(one, one)
    draw host
  }
  pass volume_fill : compute { write volume as storage  write faces as storage  write table as storage }
  pass resolve : compute {
    shader "resolve.comp" group 8 8 1
    read hdr as sampled(clamp)
    read color.prev(1) as sampled(clamp)
    read volume as sampled(clamp)
    read faces as sampled
    read table as sampled
    write color as storage
    dispatch over color
  }
  pass first : compute { read color as sampled  write target = bloom.mip(0) as storage }
  for mip in 1..mips(bloom) {
    pass down[mip] : compute {
      shader "down.comp" group 8 8 1
      read source = bloom.mip(mip - 1) as sampled(clamp)
      write target = bloom.mip(mip) as storage
      dispatch over bloom.mip(mip)
    }
  }
  pass both : compute { read hdr as storage  write hdr as storage }
  pass copy : transfer { copy hdr -> bloom.mip(0)  }
  pass final : raster {
    fullscreen "final.frag"
    read bloom as sampled(clamp)
    read scene.grown as storage
    color backbuffer
  }
  assert memory(128x96) <= 4 MiB
  warn barriers <= 40
}
