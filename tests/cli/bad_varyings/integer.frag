layout(location = 1) flat in ivec3 kind;
void main() { backbuffer = vec4(kind, 1); }
