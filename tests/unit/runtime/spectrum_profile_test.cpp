// What an engine records of a spectrum for `rgc spectrum --profile`.
#include "runtime/spectrum_profile.h"

#include <gtest/gtest.h>

namespace rg {
namespace {

struct lights {  // as generated
  static constexpr std::string_view name = "lights";
  static constexpr std::string_view features[] = {"red", "\"quoted\"", "blue"};
  static constexpr uint32_t kernels[] = {0x1, 0x6, 0x7};
};

TEST(SpectrumProfile, AKernelIsTheFirstThatHasEverything) {
  const SpectrumKernels kernels = kernels_of<lights>();
  EXPECT_EQ(kernel_for(kernels, 0), 0u);
  EXPECT_EQ(kernel_for(kernels, 1), 0u);
  EXPECT_EQ(kernel_for(kernels, 2), 1u);
  EXPECT_EQ(kernel_for(kernels, 3), 2u);
  EXPECT_EQ(kernel_for(kernels, 8), 2u) << "a bit of no feature: the last, which has all there are";
}

TEST(SpectrumProfile, TimesAreAddedUpByWeightAndDividedByGroups) {
  SpectrumProfile profile(kernels_of<lights>());
  EXPECT_TRUE(profile.costs().empty());
  profile.add_time(0, 1, 2.0, 500);
  profile.add_time(0, 3, 8.0, 1000);
  profile.add_time(2, 1, 5.0, 100);
  profile.add_time(1, 1, 5.0, 0);  // it ran nothing: that says nothing
  using Row = std::pair<uint32_t, double>;
  EXPECT_EQ(profile.costs(), (std::vector<Row>{{0x1, 1000 * (2.0 + 24.0) / (500 + 3000)}, {0x7, 50.0}}));
}

TEST(SpectrumProfile, IsWrittenAsRgcReadsIt) {
  SpectrumProfile profile(kernels_of<lights>());
  const uint32_t masks[] = {0, 3, 3, 4};
  profile.add_scene("yard", 2, masks);
  const std::string head =
      "{\n \"schema\": \"rgc-spectrum-1\",\n \"spectrum\": \"lights\",\n \"features\": [\"red\", \"\\\"quoted\\\"\", \"blue\"],\n"
      " \"scenes\": [\n  {\"name\": \"yard\", \"weight\": 2.000, \"masks\": [\n"
      "   {\"features\": [], \"tiles\": 1},\n   {\"features\": [\"red\", \"\\\"quoted\\\"\"], \"tiles\": 2},\n"
      "   {\"features\": [\"blue\"], \"tiles\": 1}\n  ]}\n ]";
  EXPECT_EQ(profile.json(), head + "\n}\n");
  profile.add_time(2, 1, 5.0, 100);
  EXPECT_EQ(profile.json(), head + ",\n \"costs\": [\n  {\"features\": [\"red\", \"\\\"quoted\\\"\", \"blue\"], \"ms\": 50.000000}\n ]\n}\n");
}

}  // namespace
}  // namespace rg
