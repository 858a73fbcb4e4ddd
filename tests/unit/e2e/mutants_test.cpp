// Damaged plans on a real driver: what the checker rejects of the classes that Khronos validation can see, validation reports, and of what the
// checker accepts it reports nothing.
#include <gtest/gtest.h>

#include <cstdlib>

#include "compiler/verify/verify.h"
#include "runtime/graph.h"
#include "tests/unit/e2e/split_frame.h"

namespace rg::test {
namespace {

// Calls `visit(what)` with each bit of each mask of each barrier left out, and with a stage more to wait for, then puts them back.
template <class Row, class Visit>
void change_bits(PlanData& plan, std::vector<Row> PlanData::*rows, const char* what, Visit visit) {
  const auto each = [&](auto mask, const char* name) {
    for (size_t i = 0; i < (plan.*rows).size(); ++i) {
      auto& value = (plan.*rows)[i].*mask;
      const auto whole = value;
      for (auto rest = whole; rest != 0; rest &= rest - 1) {
        value = whole & ~(rest & ~(rest - 1));
        visit(std::string(what) + " " + std::to_string(i) + ", " + name + " bit " + std::to_string(rest & ~(rest - 1)));
      }
      value = whole;
    }
  };
  for (size_t i = 0; i < (plan.*rows).size(); ++i) {
    Row& row = (plan.*rows)[i];
    const Row whole = row;
    row.src_stages |= stage::vertex_shader;
    visit(std::string(what) + " " + std::to_string(i) + " waiting for vertex shaders, too");
    row = whole;
  }
  each(&Row::src_stages, "source stages"), each(&Row::src_accesses, "source accesses");
  each(&Row::dst_stages, "destination stages"), each(&Row::dst_accesses, "destination accesses");
}

// What validation lets pass: what the host does, shader writes after shader writes or a transition (they could be atomics), and what comes before the
// frame, which it takes to be ordered by any barrier of the same command.
bool can_be_seen(const std::string& finding) {
  return finding.find("the host reads") == std::string::npos && finding.find("the state before the frame") == std::string::npos &&
         finding.find("shader_storage_write) writes") == std::string::npos;
}

class Mutants : public testing::Test {
 protected:
  void SetUp() override {
    DeviceOptions options;
    options.validate = true;
    options.on_message = [this](bool, std::string_view message) { messages += std::string(message) + "\n"; };
    auto created = Device::create(options);
    if (created)
      device.emplace(std::move(*created));
    else if (std::getenv("RGC_REQUIRE_GPU"))
      ADD_FAILURE() << created.error().message;
  }
  // What validation says of three frames, none of which is waited for.
  std::string run(const Plan& plan) {
    messages.clear();
    auto graph = GraphInstance::create(*device, plan, {});
    if (!graph) return graph.error().message;
    for (int frame = 0; frame < 3; ++frame)
      if (const Status status = graph->execute({}); !status) return status.error().message;
    const Status done = graph->wait_idle();
    return done ? messages : done.error().message;
  }

  std::optional<Device> device;
  std::string messages;
};

TEST_F(Mutants, AreSeenByValidationAsByTheChecker) {
  if (!device) GTEST_SKIP() << "no device";
  compiler::PlanOptions in_order;
  in_order.reorder = false;
  const compiler::CompileResult result = compile_files(kSplitFrame, in_order);
  ASSERT_FALSE(result.graphs.empty());
  PlanData plan = result.graphs[0].plans[0].plan;
  ASSERT_EQ(run(plan.view()), "");
  size_t rejected = 0, reported = 0, accepted = 0;
  const auto judge = [&](const std::string& what) {
    verify::VerifyOptions options;
    options.irredundancy = false, options.max_findings = 1;
    const auto findings = verify::verify(result.program, result.graphs[0].graph, {}, plan.view(), plan.program_pass, plan.program_resource, options);
    const std::string said = run(plan.view());
    accepted += findings.empty();
    if (findings.empty()) {
      EXPECT_EQ(said, "") << what << " is proved";
      return;
    }
    ++rejected, reported += !said.empty();
    if (can_be_seen(findings.front().text)) {
      EXPECT_NE(said, "") << what << " is not reported: " << findings.front().text;
    }
  };
  change_bits(plan, &PlanData::image_barriers, "image barrier", judge);
  change_bits(plan, &PlanData::buffer_barriers, "buffer barrier", judge);
  EXPECT_GT(rejected, 40u);
  EXPECT_GT(reported * 10, rejected * 7);
  EXPECT_GT(accepted, 10u);
  RecordProperty("rejected", static_cast<int>(rejected));
  RecordProperty("reported", static_cast<int>(reported));
  RecordProperty("accepted", static_cast<int>(accepted));
}

}  // namespace
}  // namespace rg::test
