void main() { picture = vec4(texelFetch(trail, ivec2(gl_FragCoord.xy), 0).r * vec3(1.0, 0.8, 0.5), 1.0); }
