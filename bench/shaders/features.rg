module features

feature shadows: bool
feature soft_shadows: bool
feature haze_on: bool
feature sky_light: bool
feature translucency: bool
feature sheen: bool
feature rain: bool
feature dither: bool

const TILE_LAMPS = 256
const SHADOW_TAPS = 8

sampler shadow_sampler { filter nearest  address border  compare less_equal }
sampler linear_sampler { filter linear  address clamp }

struct Lamp {
  position:  vec3
  radius:    f32
  color:     vec3
  kind:      f32  // above 0.5: a spot
  direction: vec3
  cos_angle: f32
}
struct SceneView {
  view:          mat4
  projection:    mat4
  clip_to_world: mat4
  shadow_clip:   mat4[4]
  sky:           vec4[9]
  eye:           vec4
  sun_direction: vec4
  sun_color:     vec4
  haze:          vec4
  size:          vec4
  rain:          vec4
  lamp_count:    u32
  frame:         u32
  exposure:      f32
  time:          f32
}
interface LampScene {
  lamps: buffer Lamp[]  ready as storage in compute
}
