// Clears and resolves in passes of their own, where the rendering next to them does the same by itself.
//
//   pass wipe    : transfer { clear hdr 0 }           becomes    pass draw : raster { color hdr clear 0  resolve hdr -> flat ... }
//   pass draw    : raster   { color hdr ... }                    one pass, and no barrier, load or store between the three
//   pass flatten : transfer { resolve hdr -> flat }
//
// A pass of clears and resolves goes if a raster pass can take each of them:
//   * a clear: the next pass that touches anything of the image draws over just what was cleared, in the image's own format, and would load it;
//   * a resolve: the last pass that wrote anything of the source draws to just what is resolved, and from there on nobody touches the target;
//   * both passes run in the same configurations and under the same conditions, on one queue, and are live in the same plans;
//   * nothing names the transfer pass: no `after`, `keep`, assertion or switch.
// Integers are not resolved so, because commands may keep another sample than renderings; neither is an imported target that is drawn to nowhere,
// because the engine may not have made it for that.
//
// The program stays what it means pass by pass. Proved after the fact by compiler/verify/folding.h, which shares no code with this.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "dsl/program.h"

namespace rg::compiler {

struct Fold {
  dsl::GraphId graph;
  std::string pass;  // that is gone
  struct Part {
    std::string into, image;  // the raster pass, and what it draws to
    std::string target;       // of a resolve; empty: a clear
  };
  std::vector<Part> parts;
};
struct FoldRefusal {
  dsl::GraphId graph;
  std::string pass, reason;
};
struct FoldResult {
  dsl::Program program;
  std::vector<Fold> folds;
  std::vector<FoldRefusal> refusals;  // passes of nothing but clears and resolves that stay
};

// Stages of accesses need not be known yet. `fixed` and `most_plans` say which configurations exist, see expand_configurations.
// O(accesses), and for resolves what building and culling every configuration takes.
FoldResult fold_transfers(dsl::Program program, const PlanOptions& options, const std::vector<std::string>& fixed = {}, size_t most_plans = 64);

// Why passes are gone or stay: `rgc explain` shows it.
Decisions fold_decisions(const std::vector<Fold>& folds, const std::vector<FoldRefusal>& refusals, dsl::GraphId graph);

}  // namespace rg::compiler
