// Small cases that the checker must decide right, each with the rule of the Vulkan specification that decides it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/verify/builder.h"

namespace rg::verify {

struct Litmus {
  const char* name;
  const char* rule;
  std::vector<std::string> expected;  // kinds of findings; none: legal
  void (*build)(Builder&);
};

inline void decide(const Litmus& litmus) {
  Builder b;
  litmus.build(b);
  std::string found;
  for (const Finding& finding : b.check()) found += "\n  " + finding.text;
  EXPECT_EQ(b.hazards(), litmus.expected) << litmus.rule << found;
}

inline std::string litmus_name(const ::testing::TestParamInfo<Litmus>& info) { return info.param.name; }

// Short words for the tables.
using dsl::Format;
using dsl::Role;
namespace st = stage;
namespace ac = access;
inline constexpr uint32_t kVs = dsl::stage_vertex, kFs = dsl::stage_fragment;

}  // namespace rg::verify
