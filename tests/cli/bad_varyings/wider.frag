layout(location = 0) in vec4 normal;
void main() { backbuffer = normal; }
