// Spectra of a program: their profiles are read, their kernels measured, their modes chosen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/shaders/shaders.h"
#include "compiler/spectrum/choose_modes.h"
#include "compiler/spectrum/expand_spectra.h"
#include "compiler/spectrum/profile.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

// What the costs of kernels are taken from. Times that do not tell features apart are completed by statistics, brought to their unit.
enum class CostSource : uint8_t { statistics, times, both };

struct SpectrumChoice {
  dsl::SpectrumId spectrum;
  std::string pass;                        // the first that uses it; its shader was measured
  std::optional<SpectrumProfile> profile;  // none: nothing was measured, and the problem stands on an assumption
  SpectrumProblem problem;
  ModeChoice choice = {};
  CostSource source = CostSource::statistics;
  bool provisional = false;  // taken from SpectrumOptions::earlier, and to be chosen anew
};
struct SpectrumOptions {
  std::string profile;            // path that replaces those of all spectra; empty: their own
  std::optional<uint32_t> modes;  // replaces `modes`
  Mask force = 0;                 // features that every mask gets
  const ShaderCache* cache = nullptr;
  unsigned workers = 0;
  std::function<void(std::string_view)> progress;
  // Of an earlier build: where the shader alone has changed since, its kernels are taken again, instead of building dozens to choose among. They
  // still serve every mask; what they cost is no longer known. Null: nothing is taken.
  const std::vector<SpectrumChoice>* earlier = nullptr;
};

// One row a spectrum that some pass uses, in order of declaration. Costs are the profile's, else from the statistics of the shader's kernels: for no
// feature, each feature, all, the most frequent masks, and for every set that is chosen. `read_override` reads SpectrumOptions::profile. Reports
// unreadable, foreign and empty profiles, and masks that do not match the grid of their pass.
std::vector<SpectrumChoice> resolve_spectra(const dsl::Program& program, const ReadFile& read, const ReadFile& read_override, dsl::SourceFiles& files,
                                            const SpectrumOptions& options, dsl::Diagnostics& diagnostics);

std::vector<KernelSets> kernel_sets(const std::vector<SpectrumChoice>& choices);

}  // namespace rg::compiler
