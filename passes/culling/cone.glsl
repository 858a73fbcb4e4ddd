// Wronski 2017: the sphere is beyond the cone's side, its end or its tip. Never rejects a pair that intersects while the angle is below 90 degrees.
bool cone_reaches(vec3 origin, vec3 axis, float range, float cos_angle, float sin_angle, vec3 center, float radius) {
  vec3 v = center - origin;
  float along = dot(v, axis);
  float beside = cos_angle * sqrt(max(dot(v, v) - along * along, 0.0)) - along * sin_angle;
  return !(beside > radius || along > radius + range || along < -radius);
}
