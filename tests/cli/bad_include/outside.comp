#include "../outside.glsl"
void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(1.0)); }
