vec3 reach(Light light, vec3 place) { return light.color / (1.0 + distance(light.position, place)); }
