// Extinction of every froxel.
#include "froxel.glsl"
#include "media.glsl"

void element(ivec3 at) { density = media_density(sample_of(at), cluster_volumes[cluster_of(at, domain_size())]); }
