// Program order: what every access of a program finds and leaves when passes run one after the other.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compiler/machine/cells.h"

namespace rg::machine {

// Contents of a cell. `base` names the write that defined it, `sum` adds up what commuting writers put on top, in any order.
struct Version {
  uint64_t base = 0, sum = 0;
  friend bool operator==(const Version&, const Version&) = default;
};

namespace version {  // contents that no pass wrote
inline constexpr uint64_t undefined = 0, poison = 1, torn = 2, wrong_layout = 3, partial = 4, foreign = 5;
}

// Of one access in one frame, by piece of its region.
struct Effect {
  std::vector<Version> before, after;
};

struct Reference {
  std::vector<std::vector<std::vector<Effect>>> effects;  // [frame][program pass][access]; empty for a pass that does not run
  std::vector<std::vector<std::vector<Version>>> finals;  // [frame][program resource][piece]
  std::vector<std::vector<Version>> initial;              // [program resource][piece]: before the first frame
  std::map<uint64_t, std::string> names;                  // of bases, for messages
  std::string name(Version version) const;
};

// Imported contents that the engine changes every frame; others are the same in all frames.
bool changes_outside(const dsl::Graph& graph, uint32_t resource);
// What the engine brings.
Version imported_version(const dsl::Graph& graph, uint32_t resource, uint32_t frame);

uint64_t conditions_in(const MachineOptions& options, uint32_t frame);
Reference run_in_order(const dsl::Program& program, const dsl::Graph& graph, const std::vector<uint32_t>& configuration, const Cells& cells,
                       const MachineOptions& options);

}  // namespace rg::machine
