void main() {
  uvec2 p = spectrum_pixel();
  float value = 0.0;
  if (sun) value += sin(float(p.x));
  if (soft) value += cos(float(p.y)) * sin(value);
  if (lamps)
    for (int i = 0; i < 8; ++i) value += sqrt(value + float(i));
  shown[p.y * 64u + p.x] += uint(value);
}
