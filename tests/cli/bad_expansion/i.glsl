#include "j.glsl"
#include "j.glsl"
