// Did you mean?
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rg::dsl {

// The candidate nearest to `word`, or nothing if none is near enough to be meant: insertions, deletions, substitutions and swaps of neighbours count
// one each, and up to a third of the word may differ.
std::string closest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace rg::dsl
