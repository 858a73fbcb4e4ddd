// What fusing gained, in bytes and in words.
#pragma once

#include <string>
#include <vector>

#include "compiler/fusion/fuse_passes.h"

namespace rg::compiler {

// Bytes of a kernel's elements that a frame moves less than its blocks would, and bytes of memory that its images and buffers do not take, at the
// given extents (see dsl::evaluate). Caches are not modelled: each load and store of an element counts once.
struct FusionFigures {
  uint64_t moved = 0, memory = 0;
};
FusionFigures fusion_figures(const dsl::Program& written, const FusedKernel& kernel, const std::vector<int64_t>& extents);
// Bytes that the accesses `as element` of the passes called `names` move, in the program as written.
uint64_t element_bytes(const dsl::Program& written, dsl::GraphId graph, const std::vector<std::string>& names, const std::vector<int64_t>& extents);

// What to tell about kernels, blocks and what stays in registers: `rgc explain` shows it.
struct FusionNote {
  std::string subject, what, reason;
};
std::vector<FusionNote> fusion_notes(const dsl::Program& written, const std::vector<FusedKernel>& kernels, const std::vector<FusionRefusal>& refusals,
                                     dsl::GraphId graph);

}  // namespace rg::compiler
