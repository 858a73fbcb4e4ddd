// round and round
#include "loop.glsl"
