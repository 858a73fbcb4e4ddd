// SPIRV-Tools, as functions from words to words. Thread-safe.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rg::compiler {

using Words = std::vector<uint32_t>;
std::string validate_spirv(const Words& words);  // what is wrong, for Vulkan 1.3; empty if nothing
Words optimise_spirv(const Words& words);        // performance passes; names and interface stay
Words inline_spirv(const Words& words);          // functions in their place, what nothing needs left out; in a sixth of the time
Words strip_spirv(const Words& words);           // without names and debug information
Words without_names(const Words& words);         // that alone: a walk over the words, which keep their numbers

// ---- one module, many variants

// The numbers of the specialisation constants that the module still looks at.
std::set<uint32_t> specialisation_ids(const Words& words);
// Constants in place of specialisation constants; those without a value get their default. A bool is 0 or 1.
Words set_constants(const Words& words, const std::vector<std::pair<uint32_t, uint32_t>>& values);
// What can be left out of an optimised module once its constants are set: branches not taken and what only they need; stripped. Modules that do
// the same come out with the same words more often than not.
Words prune_spirv(const Words& words);
// Optimises what pruning brought together; with prune_spirv the same instructions as optimise_spirv leaves of a module written with these constants,
// in a fraction of the time.
Words finish_spirv(const Words& words);
// Identifies the tools and what is done with them: results of another version may differ.
std::string tool_versions();

}  // namespace rg::compiler
