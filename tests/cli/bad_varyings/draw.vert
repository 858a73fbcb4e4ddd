layout(location = 0) out vec3 normal;
layout(location = 1) flat out uint kind;
void main() { normal = vec3(1.0); kind = 3u; gl_Position = vec4(0.0); }
