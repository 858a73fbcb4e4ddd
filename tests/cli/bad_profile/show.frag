void main() { backbuffer = vec4(1.0); }
