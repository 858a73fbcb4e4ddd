// Walks the lamps of a bit array in ascending order, within the range of a z-bin. Needs zbin.glsl and `uint lamp_word(uint index)`, the array.
const uint NO_LAMP = 0xFFFFFFFFu;

struct LampWalk {
  uint base, word, last;  // the array's first word; the current and the last one, relative to it
  uint lo, hi;            // lamps that count
  uint bits;              // of the current word, not yet visited
  bool wide;              // masks as on the slides
};

uint walk_bits(LampWalk w) {
  return lamp_word(w.base + w.word) & (w.wide ? zbin_mask_slide(w.word, w.lo, w.hi) : zbin_mask(w.word, w.lo, w.hi));
}

LampWalk start_walk(uint base, uint lo, uint hi, bool wide) {
  LampWalk w = LampWalk(base, 0u, 0u, lo, hi, 0u, wide);
  if (lo > hi) return w;
  w.word = lo / 32u;
  w.last = min(hi / 32u, uint(LIGHT_WORDS) - 1u);
  w.bits = walk_bits(w);
  return w;
}

uint next_of_walk(inout LampWalk w) {
  while (w.bits == 0u && w.word < w.last) {
    ++w.word;
    w.bits = walk_bits(w);
  }
  if (w.bits == 0u) return NO_LAMP;
  uint index = w.word * 32u + uint(findLSB(w.bits));
  w.bits &= w.bits - 1u;
  return index;
}
// The next one that is not plain. Needs light.glsl.
uint next_special(inout LampWalk w) {
  uint index = next_of_walk(w);
  while (index != NO_LAMP && is_plain(index)) index = next_of_walk(w);
  return index;
}
