// SPIRV-Tools, as functions from words to words. Thread-safe.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rg::compiler {

using Words = std::vector<uint32_t>;
std::string validate_spirv(const Words& words);  // what is wrong, for Vulkan 1.3; empty if nothing
Words optimise_spirv(const Words& words);        // performance passes; names and interface stay
Words strip_spirv(const Words& words);           // without names and debug information

}  // namespace rg::compiler
