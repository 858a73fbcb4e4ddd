void main() { backbuffer = texelFetch(lit, ivec2(0), 0); }
