// The world as the engine brings it.
module scene

const MAX_INSTANCES = 1024
const MAX_LIGHTS = 512
const LIGHT_WORDS = 16  // MAX_LIGHTS / 32
const TEXTURE_SIZE = 256
const TEXTURE_LAYERS = 32
const TEXTURE_MIPS = 9

const LIGHT_OMNI = 0
const LIGHT_SPOT = 1
struct Light {      // sorted by `nearest`, ascending
  position:   vec3  // world, metres
  range:      f32   // contributes exactly nothing from here on
  color:      vec3  // radiant intensity
  kind:       u32   // LIGHT_*
  direction:  vec3  // spots shine along it
  cos_outer:  f32
  nearest:    f32   // view depth of the bounding sphere, with a margin
  farthest:   f32
  cone_scale: f32   // 1 / (cos_inner - cos_outer)
  sin_outer:  f32
}

const INSTANCE_SHADOW = 1  // casts a shadow
const INSTANCE_GLASS = 2   // drawn by `transparent` only
struct Instance {
  model:       mat3x4      // columns are the rows of the affine matrix: world = vec4(p, 1) * model
  previous:    mat3x4
  center:      vec3        // world bounding sphere
  radius:      f32
  first_index: u32
  index_count: u32
  material:    u32
  flags:       u32         // INSTANCE_*
}

struct Material {
  base_color:    vec4  // alpha: opacity of glass
  emissive:      vec3
  roughness:     f32
  metallic:      f32   // of glass: the share of the sky that it mirrors
  bump:          f32   // strength of the normal map; of glass: of its ripples
  albedo_layer:  u32   // 0 is white
  surface_layer: u32   // 0 is flat, rough and not metallic; rg normal, b roughness, a metallic
}

struct Vertex {      // layout 1: the world, pulled from a storage buffer
  position: vec3
  u:        f32
  normal:   vec3
  v:        f32
  tangent:  vec4     // w: handedness times the share of the sky that is seen
}
struct PropVertex {  // layout 2: props, read as vertex attributes
  position: vec3
  normal:   u32      // octahedral, 2 x unorm16
  color:    u32      // rgba8
  surface:  u32      // rgba8: roughness, metallic, emission / 8
  part:     u32      // 0 still, 1 swings with its prop
  spare:    u32
}

interface Scene {
  lights:       buffer Light[]  ready as storage in compute, fragment
  instances:    buffer Instance[]  ready as storage in compute, vertex, fragment
  materials:    buffer Material[]  ready as storage in fragment
  vertices:     buffer Vertex[]  ready as storage in vertex
  indices:      buffer u32[]  ready as storage in vertex
  props:        buffer PropVertex[]  ready as vertex
  prop_indices: buffer u32[]  ready as index
  albedo_maps:  image rgba8_srgb 256x256 layers 32 mips 9  ready as sampled in fragment
  surface_maps: image rgba8 256x256 layers 32 mips 9  ready as sampled in fragment
}

sampler surface_sampler { filter linear  mip linear  address repeat }
