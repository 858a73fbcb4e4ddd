// Offsets of std140 and std430, worked out by hand from OpenGL 4.6, 7.6.2.2.
module layouts
struct Inner { a: f32  b: vec2 }
struct Outer {
  flag: bool
  three: vec3
  after: f32
  list: f32[3]
  rows: mat3
  wide: mat3x4
  inner: Inner
  inners: Inner[2]
  last: u32
}
struct Tight { a: f32  b: f32  c: vec2 }
