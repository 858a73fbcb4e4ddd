// The world as the engine brings it.
module scene

const MAX_INSTANCES = 1024
const MAX_LIGHTS = 512
const LIGHT_WORDS = 16  // MAX_LIGHTS / 32
const TEXTURE_SIZE = 256
const TEXTURE_LAYERS = 32
const TEXTURE_MIPS = 9

const MAX_LAMP_SHADOWS = 8

// What a lamp can do; shading kernels are chosen by the union over a tile. A lamp with none of them is a point.
const LAMP_ROUND = 1       // shines in a cone
const LAMP_SQUARE = 2      // ... in a pyramid
const LAMP_SHADOW = 4      // has a shadow map
const LAMP_SOFT = 8        // ... and a penumbra that grows with the distance from what casts it
const LAMP_PROJECTED = 16  // throws a picture
const LAMP_AREA = 32       // a rectangle that shows a picture
const LAMP_TUBE = 64       // a capsule; of no length, a sphere
const LAMP_DARK = 128      // takes light away
const LAMP_CLIPPED = 256   // shines on one side of each of two planes only
const LAMP_FEATURES = 9
struct Light {             // sorted by `nearest`, ascending
  position:  vec3          // world, metres; the middle of what shines
  range:     f32           // contributes exactly nothing from here on
  color:     vec3          // radiant intensity; of an area, radiance where its picture is white
  features:  u32           // LAMP_*
  direction: vec3          // spots and areas shine along it
  cos_outer: f32           // of the cone around everything that a spot reaches
  side:      vec3          // unit, across the direction; tubes lie along it
  sin_outer: f32
  nearest:   f32           // view depth of the bounding sphere, with a margin
  farthest:  f32
  edge:      f32           // steepness of a spot's rim: round: 1 / (cos_inner - cos_outer), square: 1 / (1 - inner / outer) in slopes
  cot:       f32           // 1 / slope of the sides of a square, projected or shadowed spot
  size:      vec2          // half length and radius of a tube, half sides of an area, radius of a soft lamp, metres
  picture:   u32           // layer of Scene::albedo_maps
  shadow:    u32           // layer of the lamps' shadow map
  clip:      vec4[2]       // shines where dot(clip, (p, 1)) >= 0
}
struct LampView {          // of one shadow map
  position:  vec3
  range:     f32
  side:      vec3
  cot:       f32
  direction: vec3
  used:      u32
}
struct LampViews { view: LampView[8] }

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

const MAX_FOG_VOLUMES = 32
// A box with fog of its own. What masks it is a texture seen along the box's y axis.
struct FogVolume {
  to_box:  mat3x4  // columns are the rows of the affine matrix: the box is -1 .. 1 in its own space
  density: f32     // extinction in its middle, 1 / metre
  edge:    f32     // share of the half side over which it fades
  layer:   u32     // of Scene::albedo_maps
  repeats: f32     // of the texture along the box
  scroll:  vec2    // repeats a second
  spare:   vec2
}

interface Scene {
  lights:       buffer Light[]  ready as storage in compute, fragment
  fog_volumes:  buffer FogVolume[]  ready as storage in compute
  instances:    buffer Instance[]  ready as storage in compute, vertex, fragment
  materials:    buffer Material[]  ready as storage in fragment
  vertices:     buffer Vertex[]  ready as storage in vertex
  indices:      buffer u32[]  ready as storage in vertex
  props:        buffer PropVertex[]  ready as vertex
  prop_indices: buffer u32[]  ready as index
  albedo_maps:  image rgba8_srgb 256x256 layers 32 mips 9  ready as sampled in compute, fragment
  surface_maps: image rgba8 256x256 layers 32 mips 9  ready as sampled in fragment
}

sampler surface_sampler { filter linear  mip linear  address repeat }
