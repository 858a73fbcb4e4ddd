void main() { backbuffer = texelFetch(waves, ivec2(gl_FragCoord.xy), 0); }
