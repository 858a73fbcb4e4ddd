#include "k.glsl"
#include "k.glsl"
