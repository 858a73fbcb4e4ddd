// One vertex of the world, by index. Needs `vertices`, `indices`, `instances`.
Vertex pull_vertex(uint at) { return vertices[indices[at]]; }
vec3 place(mat3x4 model, vec3 p) { return vec4(p, 1.0) * model; }
vec3 turn(mat3x4 model, vec3 v) { return vec4(v, 0.0) * model; }
