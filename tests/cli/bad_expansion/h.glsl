#include "i.glsl"
#include "i.glsl"
