layout(location = 0) in vec3 normal;
layout(location = 4) in vec2 place;
void main() { backbuffer = vec4(normal.xy, place); }
