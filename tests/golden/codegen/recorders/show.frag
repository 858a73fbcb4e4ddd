void main() { backbuffer = mix(texture(color, uv), texture(color_prev, uv), 0.9) + textureLod(bloom, uv, 1.0); }
