void main() { imageStore(lit, ivec2(0), vec4(1.0)); }
