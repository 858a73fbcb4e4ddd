// Tests the checker: damages one element of a plan at a time and demands that verify() objects.
//
//   element            damage
//   barrier            removed; one stage bit or access bit cleared; layout changed; contents discarded; last mip or layer left out
//   attachment         contents not loaded, not stored
//   pass               changes places with the next one
//   hand-off           stage or access bit of a release or an acquire cleared; allowed pair removed
//   placement          bytes of two resources that live at once
//
// A survivor that changes nothing belongs to a named class; any other survivor is a hole in the checker.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compiler/verify/verify.h"

namespace rg::verify {

struct MutationReport {
  size_t mutants = 0, killed = 0;
  std::map<std::string, size_t> equivalent;  // class -> mutants
  std::vector<std::string> survivors;        // one line each: what was damaged, unnoticed
};

struct MutateOptions {
  size_t every = 1;  // try every n-th mutant of each kind
  std::function<void(size_t done)> progress = {};
};

// `plan` must verify without findings. O(mutants) verifications, some 10 mutants a barrier.
MutationReport mutate(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
                      const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource, const MutateOptions& options = {});

}  // namespace rg::verify
