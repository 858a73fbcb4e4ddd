// `fuse NAME { ... }`: the blocks inside become one kernel where that changes nothing but where values are kept.
//
// Passes m0, m1, ... in order may become one, in the place of the last of them, if
//   * all are blocks over one domain, on one queue, under the same features and conditions of the host, with one engine set;
//   * those that scan do so along one axis;
//   * whatever one writes, another touches only at its own element, except that atomic operations of both on one resource stay as they are;
//   * no pass between them touches what an earlier one of them wrote, or writes what it read;
//   * the kernel still has an image that says where its domain ends, and its workgroup memory fits.
// Everything else a block could do to another element its language does not have: no barriers, shared memory, subgroups, places of invocations.
//
// Images and buffers that a member writes and nothing but later members reads leave the program. The members stay what they are under
// `when TERM`, where the term does not hold. Proved after the fact by compiler/verify/fusion.h, which shares no code with this.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/fusion/conversions.h"
#include "compiler/shaders/shaders.h"
#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

struct FusedKernel {
  dsl::GraphId graph;
  std::string fusion, pass;          // the `fuse`, and the pass it became
  std::vector<std::string> members;  // of the program as written
  struct Saved {                     // elements of `resource` are moved so many times less
    dsl::ResourceId resource;
    uint32_t accesses = 0;
    bool dropped = false;  // and it has no memory any more
  };
  std::vector<Saved> saved;
};
struct FusionRefusal {
  dsl::GraphId graph;
  std::string fusion, pass, reason;
  std::vector<std::pair<dsl::Span, std::string>> places;  // what forbids it
};
struct FusionOptions {
  bool fuse = true;  // false: every block is a kernel of its own
  HalfRounding halves = HalfRounding::zero;
};
struct FusionResult {
  dsl::Program program;  // without blocks
  std::vector<FusedKernel> kernels;
  std::vector<FusionRefusal> refusals;  // of fusions that `may` leave passes apart
};
// Reports blocks that cannot be read or do what no block may, and fusions that cannot be. `files` gets the sources that diagnostics point into.
// O(passes + members^2 * accesses^2 of each fusion).
FusionResult fuse_passes(dsl::Program program, const ReadFile& read, dsl::SourceFiles& files, const FusionOptions& options,
                         dsl::Diagnostics& diagnostics);

// Why `next` cannot run in one kernel with the passes of `group`, all earlier; nothing if it can.
struct Obstacle {
  std::string why;
  std::vector<std::pair<dsl::Span, std::string>> places;
};
std::optional<Obstacle> find_obstacle(const dsl::Program& program, const dsl::Graph& graph, const std::vector<dsl::PassId>& group, dsl::PassId next);

}  // namespace rg::compiler
