// From this frame's place to last frame's, in texture coordinates, without jitter.
vec2 screen_velocity(vec4 now, vec4 before) { return (before.xy / before.w - now.xy / now.w) * 0.5; }
