void main() {
  uint bin = gl_GlobalInvocationID.x;
  if (bin >= ZBINS) return;
  zbins[bin] = zbin_min[bin] | (zbin_max[bin] << 16);
}
