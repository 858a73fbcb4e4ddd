// Random programs that use the whole language: what random_program.h has, and pieces for each construct beside it, joined by what they read and
// update.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace rg::test {

// Queues as orders and permissions, features, conditions, loops over mips and mips an image may lack, depth and stencil apart, disjoint and commuting
// writers, arguments of indirect work, copies and blits, resolves, techniques, histories, `after`, `keep`, `no alias`, outputs. The same seed gives
// the same text.
std::string make_wide_program(uint64_t seed, uint32_t pieces);

// The smallest text found, by taking out statements and blocks, for which `fails` still holds. O(lines^2) calls.
std::string shrink(std::string text, const std::function<bool(const std::string&)>& fails);

}  // namespace rg::test
