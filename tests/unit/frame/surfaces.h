// What the shading tests share: the G-buffer as surfaces, and what lamps look up.
#pragma once

#include "tests/reference/lamps.h"
#include "tests/unit/frame/lab.h"

namespace rg::test {

struct GBuffer {
  Texels depth, albedo, normal, material, emissive;
};
GBuffer read_gbuffer(Lab& lab, const FrameData& data);
reference::SurfacePoint surface_at(const GBuffer& g, const FrameData& data, int x, int y);

void clear_fog(FrameData& data);
void keep_lamps_only(FrameData& data);  // no sun, no sky, no fog

// The scene's texture layers, filtered, and the shadow maps that a frame of `data` draws, as the shaders read them. NaN where a compare is too close
// to call.
reference::LampTextures make_lookups(Lab& lab, const FrameData& data, const Scene& scene);

// Channel by channel, within `relative` of what is expected and `slack`.
void expect_close(const glm::vec4& actual, const glm::dvec3& expected, double relative, const glm::dvec3& slack, int x, int y);

}  // namespace rg::test
