// Frames on a real driver, and what they leave in a buffer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/plan.h"
#include "tests/unit/e2e/compiled.h"

namespace rg::test {

using Words = std::vector<uint32_t>;

// The checker finds nothing wrong with any plan.
void expect_proved(const compiler::CompileResult& result);

// The words of the one buffer that is read back, after as many frames; none where something failed. No value where there is no device.
// With `validate`, what Khronos validation reports fails the test.
// `without`: what the device has and shall not use.
std::optional<Words> run(const Files& files, uint32_t frames = 1, bool validate = false, std::vector<Capability> without = {});

// Of the device that `run` runs on; false where there is none.
bool device_has(Capability capability);

}  // namespace rg::test
