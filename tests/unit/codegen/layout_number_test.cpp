// A running program is refused plans whose enums no longer mean what its own do.
#include "compiler/codegen/layout_number.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

uint32_t layout(std::vector<std::string> values) {
  dsl::Feature feature;
  feature.name = "path", feature.values = std::move(values);
  return layout_of_values(feature);
}

TEST(LayoutNumber, ValuesCountByNameAndOrder) {
  EXPECT_EQ(layout({"off", "on"}), 0u);
  EXPECT_EQ(layout({"low", "mid", "high"}), layout({"low", "mid", "high"}));
  EXPECT_NE(layout({"low", "mid", "high"}), layout({"mid", "low", "high"}));
  EXPECT_NE(layout({"low", "mid", "high"}), layout({"low", "mid", "best"}));
  EXPECT_NE(layout({"on", "off"}), 0u);
  EXPECT_NE(layout({"ab", "c"}), layout({"a", "bc"}));
}

}  // namespace
}  // namespace rg::compiler
