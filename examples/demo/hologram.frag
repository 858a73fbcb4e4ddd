#version 460
layout(push_constant) uniform Draw { mat4 model_to_clip; vec4 color; } draw;
layout(location = 0) in float in_brightness;
layout(location = 0) out vec4 hdr;

void main() { hdr = vec4(draw.color.rgb * draw.color.a * in_brightness, 0.0); }
