void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); imageStore(target, at, imageLoad(target, at) * 3.0); }
