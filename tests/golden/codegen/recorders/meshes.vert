layout(location = 0) out vec3 world;

void main() {
  world = position + float(table[per_draw.model]);
  gl_Position = view_constants.world_to_clip * vec4(world, texcoord.x);
}
