// Runs SHADE(light index) over a tile's bit array `WORDS`, ascending, within the words a z-bin allows.
#define FOR_EACH_LIGHT(WORDS, TILE_INDEX, LO, HI, MASK, SHADE)                                              \
  for (uint word = (LO) / 32u; word <= min((HI) / 32u, uint(LIGHT_WORDS) - 1u) && (LO) <= (HI); ++word)     \
    for (uint bits = WORDS[(TILE_INDEX) * LIGHT_WORDS + word] & MASK(word, LO, HI); bits != 0u; bits &= bits - 1u) \
      SHADE(word * 32u + uint(findLSB(bits)))
