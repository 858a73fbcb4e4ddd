// Runs of the front end and specialisations: the expensive part, in parallel and through the cache.
#pragma once

#include <map>
#include <vector>

#include "compiler/shaders/cache.h"
#include "compiler/shaders/shader_work.h"

namespace rg::compiler {

struct FrontEndResult {
  std::vector<ShaderMessage> errors;
  Reflection reflection;       // of the module as written
  ModuleUses uses;             // of `generic`
  Words generic;               // optimised, specialisation constants open, named
  std::set<uint32_t> numbers;  // of the specialisation constants it still looks at
  Digest key;                  // of `generic` and the tools; only with a cache
  bool hurried = false;        // `generic` has its functions in place and is not optimised
};
std::vector<FrontEndResult> run_front_ends(const std::vector<FrontEndJob>& jobs, ShaderSources& sources, const ShaderOptions& options);

// Of everything that the variants of `space` are made from.
Digest digest_of_variants(const dsl::Program& program, dsl::GraphId graph, const VariantSpace& space, const ReadFile& read);

using ConstantValues = std::vector<std::pair<uint32_t, uint32_t>>;  // number of a specialisation constant, value; ascending
struct SpecialiseJob {
  size_t front_end = 0;
  ConstantValues values;  // of exactly FrontEndResult::numbers
  friend auto operator<=>(const SpecialiseJob&, const SpecialiseJob&) = default;
};
struct Specialised {
  std::vector<Words> words;  // by job
  bool complete = true;      // false: some are not final, see ShaderEffort::preview
};
// Optimised, stripped and, unless they are only measured, validated SPIR-V of each job. Jobs whose modules are equal once pruned share the rest of
// the work.
Specialised specialise(const std::vector<SpecialiseJob>& jobs, const std::vector<FrontEndResult>& front_ends, const ShaderOptions& options);

}  // namespace rg::compiler
