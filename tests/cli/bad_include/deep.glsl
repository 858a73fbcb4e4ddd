
#include "nowhere.glsl"
