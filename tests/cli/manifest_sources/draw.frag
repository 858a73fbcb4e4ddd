#include "colour.glsl"
void main() { backbuffer = colour(); }
