// Choices of modes in the cache of shaders: building and measuring dozens of kernels to find the same few again is most of a build without changes.
#pragma once

#include <optional>

#include "compiler/shaders/cache.h"
#include "compiler/spectrum/choose_modes.h"

namespace rg::compiler {

// What a choice leaves behind: the costs it went by and itself.
struct KeptChoice {
  CostModel costs;
  ModeChoice choice;
};

// Of everything that the choice depends on: the problem as it is before any kernel was measured, and the kernels' sources.
Digest choice_key(const SpectrumProblem& problem, const Digest& sources);
// Nothing where there is none, or one that does not fit the problem.
std::optional<KeptChoice> find_choice(const ShaderCache& cache, const Digest& key, const SpectrumProblem& problem);
void store_choice(const ShaderCache& cache, const Digest& key, const KeptChoice& kept);

}  // namespace rg::compiler
