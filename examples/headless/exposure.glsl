vec3 expose(vec3 light, float exposure) { return 1.0 - exp(-light * exposure); }
