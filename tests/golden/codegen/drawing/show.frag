void main() { linear = vec4(uv, 0.0, 1.0); }
