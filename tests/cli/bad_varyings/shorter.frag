layout(location = 0) in vec2 normal;
void main() { backbuffer = vec4(normal, 0, 1); }
