// What every pass may know about the camera and the frame, and how to read the pictures it makes.
module view

// View space: x right, y down, z forward, so that clip = (scale.x x + jitter.x z, scale.y y + jitter.y z, near, z):
// depth is reversed, 1 at the near plane and 0 at infinity, and y needs no flip after the projection.
struct View {
  world_to_view:    mat4
  world_to_clip:    mat4  // jittered
  clip_to_world:    mat4  // of the jittered one
  steady_to_clip:   mat4  // world to clip without jitter
  previous_to_clip: mat4  // last frame's steady_to_clip
  world_to_sun:     mat4  // orthographic, reversed depth
  position:         vec3  // of the camera, metres
  near:             f32
  sun_direction:    vec3  // towards the sun
  time:             f32   // seconds
  sun_color:        vec3  // irradiance on a plane that faces the sun
  sun_texel:        f32   // metres a shadow map texel covers
  ambient:          vec3  // irradiance of a clear sky's zenith
  exposure_bias:    f32   // stops
  scale:            vec2  // of the projection
  jitter:           vec2  // clip space offset of this frame
  size:             vec2  // pixels
  inverse_size:     vec2
  zbin_scale:       f32   // bins a metre
  sun_ndc:          f32   // clip space units a metre in the shadow map
  light_count:      u32
  instance_count:   u32
  frame:            u32
  debug_view:       u32   // DEBUG_*
  light_path:       u32   // LIGHT_PATH_*
  forced_features:  u32   // LAMP_* that every tile is shaded with, whether its lamps have them or not
  noise:            u32   // 0 stills every per-frame variation that is not camera jitter
}

sampler linear_clamp { filter linear  mip linear  address clamp }
