void main() { gl_Position = vec4(position.xy + place + vec2(gl_ViewIndex, texcoord.x), 0.0, tint.a); }
