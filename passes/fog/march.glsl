// A stretch of even fog: what it scatters towards its near end, and the share of light from behind that comes through.
struct Stretch { vec3 light; float through; };

// (1 - exp(-x)) / x, which loses its digits near 0.
float absorbed_share(float x) { return x < 1e-3 ? 1.0 - x * (0.5 - x * (1.0 / 6.0)) : (1.0 - exp(-x)) / x; }

Stretch make_stretch(vec3 inscatter, float extinction, float metres) {
  float thickness = extinction * metres;
  return Stretch(inscatter * (metres * absorbed_share(thickness)), exp(-thickness));
}

// `near` in front of `far`; associative.
Stretch join(Stretch near, Stretch far) { return Stretch(near.light + near.through * far.light, near.through * far.through); }
