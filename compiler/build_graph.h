// Who must come before whom, and why: exact dependencies between the versions of each cell.
//
//   pass      cell a            versions of a                  dependencies
//   A         write             v1 by A
//   B         read              v1 read by B                   A -> B  read after write
//   C         read              v1 read by C                   A -> C  read after write
//   D         write             v2 by D                        B -> D, C -> D  write after read
//   E, F      atomic            v3 by E and F                  D -> E, D -> F; none between E and F
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/frame.h"

namespace rg::compiler {

enum class DependencyKind : uint8_t {
  read_after_write,
  write_after_read,
  write_after_write,
  layout,  // two readers of one version that need different layouts
  order,   // `after`: in this order, without a barrier of its own
};
const char* name(DependencyKind kind);

struct Dependency {
  uint32_t before = 0, after = 0;  // passes of the frame
  DependencyKind kind = DependencyKind::read_after_write;
  uint32_t cell = UINT32_MAX;
  friend bool operator==(const Dependency&, const Dependency&) = default;
};

struct Graph {
  std::vector<Dependency> dependencies;             // by `after`, then `before`; one row a pair, cell and kind; before < after always
  std::vector<std::vector<uint32_t>> last_writers;  // by cell: writers of the version that reaches the end of the frame
};

// Considers passes with live[pass] only. O(uses + dependencies); a version with r readers and w sharing writers has r * w of them.
Graph build_graph(const Frame& frame, const std::vector<bool>& live);

}  // namespace rg::compiler
