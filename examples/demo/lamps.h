// Lamps of a scene as the graph wants them, at a point in time, and the views of their shadow maps.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "examples/demo/scene.h"
#include "frame.h"

namespace rg::demo {

rg::vec2 to_rg(glm::vec2 v);
rg::vec3 to_rg(glm::vec3 v);
rg::vec4 to_rg(glm::vec4 v);
rg::mat4 to_rg(const glm::mat4& m);
rg::mat3x4 to_rows(const glm::mat4& m);  // affine

// Sorted by nearest; those beyond frame::MAX_LIGHTS are the farthest ones and are left out.
std::vector<frame::Light> make_lights(const Scene& scene, const glm::mat4& to_view, float time);
frame::LampViews make_lamp_views(const Scene& scene);

}  // namespace rg::demo
