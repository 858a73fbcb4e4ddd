#include "b.glsl"
#include "b.glsl"
