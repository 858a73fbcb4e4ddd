#include "compiler/workarounds.h"

#include <algorithm>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

// Columns: aliasing, async, reorder, merge, discard, fold, split. Rows with a driver have a public report as their source, named in docs/planner.md.
constexpr Workaround kWorkarounds[] = {
    {"foreign-texels", "any", "a transient shows what another resource left, though the checker proves the plan", true, false, false, false, false,
     false, false},
    {"lost-tiles", "any", "later passes of a rendering miss what earlier ones drew", false, false, false, true, false, false, false},
    {"stale-compression", "any", "blocks of old contents after a discard, where compression data is not reset", false, false, false, false, true,
     false, false},
    {"hung-queue", "any", "device lost, or a frame that never ends, with several queues only", false, true, false, false, false, false, false},
    {"radv-2023-async", "MESA_RADV of early 2023", "the machine hangs in asynchronous compute", false, true, false, false, false, false, false},
    {"unset-event", "any", "the machine stops at the wait for an event, or nobody waits for it", false, false, false, false, false, false, true},
    {"conservative", "any", "to find out whether it is the plan at all: everything at once", true, true, true, true, true, true, true},
};

}  // namespace

std::span<const Workaround> known_workarounds() { return kWorkarounds; }

std::vector<std::string> workaround_names() {
  std::vector<std::string> names;
  for (const Workaround& row : kWorkarounds) names.emplace_back(row.name);
  return names;
}

void apply_workaround(PlanOptions& options, const std::string& name) {
  const auto row = std::find_if(std::begin(kWorkarounds), std::end(kWorkarounds), [&](const Workaround& each) { return each.name == name; });
  RG_CHECK(row != std::end(kWorkarounds), "the work-around is known");
  options.aliasing = options.aliasing && !row->no_aliasing;
  options.async = options.async && !row->no_async;
  options.reorder = options.reorder && !row->no_reorder;
  options.merge = options.merge && !row->no_merge;
  options.discard = options.discard && !row->no_discard;
  options.fold = options.fold && !row->no_fold;
  options.split = options.split && !row->no_split;
}

}  // namespace rg::compiler
