void main() { backbuffer = texture(bark, gl_FragCoord.xy); }
