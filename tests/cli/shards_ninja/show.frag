void main() { backbuffer = texelFetch(lit, ivec2(gl_FragCoord.xy), 0); }
