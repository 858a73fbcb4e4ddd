// How long each pass takes, for decisions about queues: measured, or estimated from what it touches.
//
// The estimate is that of a GPU of the middle class: a pass takes kLaunchNs and then the longer of its memory traffic and its invocations. It ranks
// passes of one frame against each other; nobody should read milliseconds off it. A profile replaces it pass by pass.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/frame.h"

namespace rg::compiler {

inline constexpr double kLaunchNs = 2000, kBytesPerNs = 300, kInvocationsPerNs = 20;
inline constexpr double kWaitNs = 4000;  // from the end of a batch to the start of one that waits for it

// By pass of the frame, in ns, greater than 0. O(accesses).
std::vector<double> pass_costs(const Frame& frame, const std::map<std::string, double>& measured_us);

// A cost profile, as the generated frame or a tool writes it:
//
//   { "schema": "rgc-profile-1", "graph": "frame", "passes_us": { "light_cull": 41.5, "bloom_down[1]": 3.2 } }
//
// `wrong` says why it cannot be used, `unknown` lists passes that the graph does not have.
struct Profile {
  std::string graph;
  std::map<std::string, double> passes_us;
  std::string wrong;
};
Profile parse_profile(std::string_view json);

}  // namespace rg::compiler
