layout(local_size_x = 4, local_size_y = 4) in;
void main() { imageStore(a, ivec2(0), vec4(1)); }
