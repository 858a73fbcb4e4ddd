#include "f.glsl"
#include "f.glsl"
