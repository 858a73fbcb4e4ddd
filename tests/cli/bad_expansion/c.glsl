#include "d.glsl"
#include "d.glsl"
