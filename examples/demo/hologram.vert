#version 460
// A globe of lines without any buffer: twelve meridians, then seven parallels, as a line list.
layout(push_constant) uniform Draw { mat4 model_to_clip; vec4 color; } draw;
layout(location = 0) out float out_brightness;

const int SEGMENTS = 48, MERIDIANS = 12, PARALLELS = 7;
const float PI = 3.14159265;

vec3 on_globe(float longitude, float latitude) { return vec3(cos(longitude) * cos(latitude), sin(latitude), sin(longitude) * cos(latitude)); }

void main() {
  int line = gl_VertexIndex / 2, ring = line / SEGMENTS;
  float along = float(line % SEGMENTS + gl_VertexIndex % 2) / float(SEGMENTS);
  vec3 p;
  if (ring < MERIDIANS) p = on_globe(PI * float(ring) / float(MERIDIANS), 2.0 * PI * along);
  else p = on_globe(2.0 * PI * along, PI * (float(ring - MERIDIANS + 1) / float(PARALLELS + 1) - 0.5));
  out_brightness = ring % 3 == 0 ? 1.0 : 0.35;
  gl_Position = draw.model_to_clip * vec4(p * 0.85, 1.0);
}
