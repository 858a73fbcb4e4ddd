#include "l.glsl"
#include "l.glsl"
