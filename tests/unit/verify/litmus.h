// Small cases that the checker must decide right, each with the rule of the Vulkan specification that decides it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "compiler/machine/machine.h"
#include "tests/unit/verify/builder.h"

namespace rg::verify {

struct Litmus {
  const char* name;
  const char* rule;
  std::vector<std::string> expected;  // kinds of findings; none: legal
  void (*build)(Builder&);
};

// What the abstract machine says of the case.
inline std::string run_machine(Builder& b) {
  std::string found;
  machine::MachineOptions options;
  const auto& rows = b.graph().resources.rows;
  // What comes in free of any access is free once.
  if (std::any_of(rows.begin(), rows.end(), [](const dsl::Resource& row) { return row.lifetime == dsl::Lifetime::imported; })) options.frames = 1;
  for (const bool united : {false, true}) {
    options.united = united;
    for (const machine::Divergence& each : machine::run_adversarially(b.program, dsl::GraphId{size_t{0}}, b.configuration, b.view(),
                                                                      b.plan.program_pass, b.plan.program_resource, options))
      found += "\n  " + machine::text(each);
  }
  return found;
}

inline void decide(const Litmus& litmus) {
  Builder b;
  litmus.build(b);
  std::string found;
  for (const Finding& finding : b.check()) found += "\n  " + finding.text;
  EXPECT_EQ(b.hazards(), litmus.expected) << litmus.rule << found;
  // What the machine runs must go wrong in nothing that is right.
  if (litmus.expected.empty()) {
    EXPECT_EQ(run_machine(b), "");
  }
}

inline std::string litmus_name(const ::testing::TestParamInfo<Litmus>& info) { return info.param.name; }

// Short words for the tables.
using dsl::Format;
using dsl::Role;
namespace st = stage;
namespace ac = access;
inline constexpr uint32_t kVs = dsl::stage_vertex, kFs = dsl::stage_fragment;

}  // namespace rg::verify
