// Drivers on which a plan has to do without something, by name: `rgc build --workaround NAME`.
//
// A table and not a guess at run time, because a plan is made ahead of time: whoever ships to such a driver compiles a second plan with the
// work-around and picks it by VkPhysicalDeviceDriverProperties. Pictures are the same with every combination of switches.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compiler/plan_frame.h"

namespace rg::compiler {

struct Workaround {
  const char* name;
  const char* drivers;  // vendor and driver as VkDriverId calls it; "any" where a symptom is all that is known
  const char* symptom;
  bool no_aliasing, no_async, no_reorder, no_merge, no_discard, no_fold, no_split;
};
std::span<const Workaround> known_workarounds();
std::vector<std::string> workaround_names();

// Switches off what the work-around names. Pre-condition: it is known.
void apply_workaround(PlanOptions& options, const std::string& name);

}  // namespace rg::compiler
