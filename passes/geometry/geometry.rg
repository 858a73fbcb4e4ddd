// From instances to a G-buffer: culling, indirect draws of the world, recorded draws of the props.
module geometry

struct DrawArguments { vertex_count: u32  instance_count: u32  first_vertex: u32  first_instance: u32 }
// What a slot would draw; seen and lit: whether it may be, for the camera and for the sun.
struct Candidate { draw: DrawArguments  center: vec3  radius: f32  seen: u32  lit: u32 }
struct PropDraw { model: mat3x4  previous: mat3x4  tint: vec3  swing: f32  swing_before: f32  sky: f32 }  // sky: share of it that is seen
struct GlassDraw { instance: u32 }
struct HologramDraw { model_to_clip: mat4  color: vec4 }

const COUNT_VISIBLE = 0  // of `cull_counts`
const COUNT_OUTSIDE = 1
const COUNT_SUN = 2
const COUNT_TRIANGLES = 3

const SUN_SHADOW_SIZE = 1536

condition lamps_moved

state world_depth { cull back  depth test greater_equal  depth write on }
state world_equal { cull back  depth test greater_equal  depth write off }
state caster      { cull none  depth test greater_equal  depth write on }
