// How much of the sky a point sees among boxes: what keeps arcades and rooms dark.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "examples/demo/scene.h"

namespace rg::demo {

struct Box {
  glm::vec3 low{0}, high{0};
};

// The share of a cosine-weighted hemisphere about `normal` that no box hides, in [0, 1]. A little light gets everywhere: never below `least`.
float sky_share(glm::vec3 position, glm::vec3 normal, std::span<const Box> boxes, float least = 0.015f);

// Sets |tangent.w| of every vertex, keeping its sign, and `sky` of every prop. Runs on two threads; the result does not depend on them.
void bake_sky(Scene& scene, std::span<const Box> boxes);

}  // namespace rg::demo
