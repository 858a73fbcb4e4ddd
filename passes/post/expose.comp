// The mean of log luminance between the 40th and the 95th percentile, put on middle grey; eyes take a while to follow.
#include "exposure.glsl"

const float LOW = 0.40, HIGH = 0.95, GREY = 0.18, FOLLOW = 0.08;

float mean_log_luminance() {
  float total = 0.0;
  for (uint i = 0u; i < HISTOGRAM_BINS; ++i) total += float(histogram[i]);
  float first = total * LOW, last = total * HIGH, seen = 0.0, sum = 0.0, weight = 0.0;
  for (uint i = 0u; i < HISTOGRAM_BINS; ++i) {
    float next = seen + float(histogram[i]);
    float inside = max(min(next, last) - max(seen, first), 0.0);
    sum += inside * bin_log_luminance(float(i));
    weight += inside;
    seen = next;
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

void main() {
  float now = mean_log_luminance();
  Exposure before = exposure_prev[0];
  float adapted = before.valid > 0.0 ? mix(before.log_luminance, now, FOLLOW) : now;
  exposure[0] = Exposure(GREY * exp2(-adapted + camera.exposure_bias), adapted, now, 1.0);
}
