// Bins are uniform in view depth. One correctly rounded product and a truncation: the same on every machine, and monotone.
uint zbin_of(float depth) { return uint(clamp(depth * camera.zbin_scale, 0.0, float(ZBINS - 1))); }

// Bits lo..hi of the 512 that fall into `word`; exact. None for an empty bin.
uint zbin_mask(uint word, uint lo, uint hi) {
  int first = max(int(lo) - int(32u * word), 0);
  int last = min(int(hi) - int(32u * word), 31);
  if (first > last) return 0u;
  return (0xFFFFFFFFu >> uint(31 - (last - first))) << uint(first);
}

// As the slides have it: the width is not clipped to the word, so that words around the range include too much, never too little.
uint zbin_mask_slide(uint word, uint lo, uint hi) {
  uint first = uint(clamp(int(lo) - int(32u * word), 0, 31));
  uint count = uint(clamp(int(hi) - int(lo) + 1, 0, 32));
  return (count == 32u ? 0xFFFFFFFFu : (1u << count) - 1u) << first;
}
