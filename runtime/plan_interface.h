// Whether a plan that is loaded fits the program that was compiled for another one.
#pragma once

#include <string_view>

#include "runtime/plan.h"
#include "runtime/result.h"

namespace rg {

// Done if callers that were written for `built` can execute `loaded`: it has the same extents, and asks for no import, parameter block, update,
// condition, feature, engine set or callback that `built` does not have in the same place, of the same kind and C++ layout. It may ask for fewer.
// Else `invalid_argument`, with what changed. What happens inside a frame - passes, resources, formats, shaders, barriers - may be anything. O(rows
// of both plans).
Status check_interface(const Plan& built, const Plan& loaded);

// By name; kNone: there is none. O(rows).
Index find_pass(const Plan& plan, std::string_view name);
// Likewise.
Index find_resource(const Plan& plan, std::string_view name);

}  // namespace rg
