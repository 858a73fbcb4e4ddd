// Frames on a real driver, and what they leave in a buffer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/plan.h"
#include "tests/unit/e2e/compiled.h"

namespace rg::test {

using Words = std::vector<uint32_t>;

// Ends a frame with a pass `show` that hands the 8x8 texels of `seen`, an image of r32ui, to the host; and its shader, show.comp.
inline const std::string kShow = R"(
  buffer shown : u32[64] readback
  pass show : compute { shader "show.comp" group 8 8 1  read seen as sampled  write shown as storage  dispatch over 8x8 }
})";
inline constexpr const char* kShowShader =
    "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); shown[8 * at.y + at.x] = texelFetch(seen, at, 0).x; }";

// The checker finds nothing wrong with any plan, nor with what became of the program before.
void expect_proved(const compiler::CompileResult& result);

// The words of the one buffer that is read back, after as many frames; none where something failed. No value where there is no device.
// With `validate`, what Khronos validation reports fails the test.
// `without`: what the device has and shall not use.
std::optional<Words> run(const Files& files, uint32_t frames = 1, bool validate = false, std::vector<Capability> without = {},
                         const compiler::PlanOptions& plan = {});

// Of the device that `run` runs on; false where there is none.
bool device_has(Capability capability);

}  // namespace rg::test
