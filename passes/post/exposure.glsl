// The histogram's bins are uniform in log2 of luminance.
const float LOG_LEAST = -10.0, LOG_GREATEST = 6.0;

float luminance_of(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
uint histogram_bin(float luminance) {
  float x = (log2(max(luminance, 1e-6)) - LOG_LEAST) / (LOG_GREATEST - LOG_LEAST);
  return uint(clamp(x, 0.0, 1.0) * float(HISTOGRAM_BINS - 1) + 0.5);
}
float bin_log_luminance(float bin) { return mix(LOG_LEAST, LOG_GREATEST, bin / float(HISTOGRAM_BINS - 1)); }
