void main() { backbuffer = texelFetch(base, ivec2(gl_FragCoord.xy), 0); }
