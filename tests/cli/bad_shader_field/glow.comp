void main() { imageStore(lit, ivec2(0), imageLoad(lit, ivec2(0)) * camera.aperture); }
