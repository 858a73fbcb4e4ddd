// Tests the checker: damages one element of a plan at a time and demands that verify() objects.
//
//   element            damage
//   barrier            removed; one stage bit or access bit cleared; layout changed; contents discarded; last mip or layer left out
//   attachment         contents not loaded, not stored
//   pass               changes places with the next one; moved to another queue
//   wait, signal       removed; one stage bit cleared; waits for an earlier value, or for the frame before
//   ownership          a half of a transfer becomes a plain barrier, or goes the other way; a shared resource becomes exclusive
//   hand-off           stage or access bit of a release or an acquire cleared; release a point too early; clock a point too far
//   placement          bytes of two resources that live at once
//
// A survivor that changes nothing belongs to a named class, and a second, independent opinion must agree that it changes nothing; any other survivor
// is a hole in the checker.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compiler/verify/verify.h"

namespace rg::verify {

struct KindReport {
  size_t made = 0, killed = 0;
  size_t asked = 0, agreed = 0;  // killed mutants the second opinion was asked about, and rejected, too
};
struct MutationReport {
  size_t mutants = 0, killed = 0;
  std::map<std::string, KindReport> kinds;   // of damage
  std::map<std::string, size_t> equivalent;  // class -> mutants
  std::map<std::string, size_t> confirmed;   // class -> of them those that the second opinion was asked about
  std::vector<std::string> survivors;        // one line each: what was damaged, unnoticed
};

struct MutateOptions {
  size_t every = 1, first = 0;  // try every n-th mutant, after `first` others
  // True if the plan misbehaves, by a judge that shares nothing with verify(): the abstract machine. Asked about mutants that verify() accepts, and
  // about every n-th that it rejects, but no more than so many times for each class and each kind; about survivors without a class always.
  std::function<bool(const Plan&)> misbehaves = {};
  size_t ask_every = 0, ask_at_most = SIZE_MAX;
  std::function<void(size_t done)> progress = {};
};

// `plan` must verify without findings. O(mutants) verifications, some 10 mutants a barrier.
MutationReport mutate(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
                      const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource, const MutateOptions& options = {});

}  // namespace rg::verify
