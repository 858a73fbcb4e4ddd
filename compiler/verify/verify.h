// The checker: does a plan mean what its program says, for every outcome of conditions, every allowed placement and
// every frame after every frame? Shares with the planner the plan schema, the program and nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::verify {

enum class Hazard : uint8_t {
  read_after_write,
  write_after_read,
  write_after_write,  // missing dependency
  wrong_layout,
  poison_read,
  wrong_version,
  lost_contents,
  alias_race,
  invalid_barrier,
  boundary_mismatch,
  ownership,   // of a queue family
  submission,  // queues, batches, waits and signals
  missing_pass,
  order,
  invalid_plan,
  redundant,
};
const char* name(Hazard hazard);

struct Finding {
  Hazard hazard = Hazard::invalid_plan;
  std::string resource, first_pass, second_pass;  // the two accesses that collide; empty where there is none
  std::string text;                               // one line: both accesses, the range, the missing edge
};

struct VerifyOptions {
  bool irredundancy = true;  // also report atoms whose removal breaks nothing and that carry no tag
  size_t max_findings = 20;
  std::vector<std::vector<int64_t>> extents = {};  // proved for these too, besides the initial and the maximal ones; 3 values an extent
};

// `configuration` holds one value a feature; `program_pass[i]` and `program_resource[i]` name the program rows of plan pass and resource i.
std::vector<Finding> verify(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
                            const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource,
                            const VerifyOptions& options = {});

}  // namespace rg::verify
