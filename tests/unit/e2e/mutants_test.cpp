// Damaged plans on a real driver: what the checker rejects of the classes that Khronos validation can see, validation reports, and of what the
// checker accepts it reports nothing.
#include <gtest/gtest.h>

#include <cstdlib>

#include "compiler/verify/verify.h"
#include "runtime/graph.h"
#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// Raster, compute and transfer; attachments, sampled and storage images, buffers, history, a read-back; one barrier with an event.
const Files kDamaged = {
    {"frame.rg", R"(
target vulkan 1.3 with split_barriers
state flat { cull none }
graph frame() {
  image base   : rgba8 8x8
  image mask   : rgba8 8x8
  image extra  : rgba8 8x8
  buffer tones : u32[64]
  buffer twins : u32[64]
  image trail  : r32ui 8x8 history 1 init clear 7
  image seen   : r32ui 8x8
  pass first  : raster { shader "full.vert" "two.frag"  state flat  color base clear 0  color mask clear 0  draw 3 }
  pass tone   : compute { shader "tone.comp" group 8 8 1  read mask as sampled  write tones as storage  dispatch over 8x8 }
  pass more   : raster { shader "full.vert" "more.frag"  state flat  read mask as sampled in fragment  color extra clear 0  draw 3 }
  pass twin   : transfer { copy tones -> twins }
  pass light  : compute { shader "light.comp" group 8 8 1  read base as sampled  read twins as storage  read trail.prev(1) as sampled  write trail as storage  dispatch over 8x8 }
  pass mix    : compute { shader "mix.comp" group 8 8 1  read trail as sampled  read extra as sampled  write seen as storage  dispatch over 8x8 })" +
                     kShow},
    {"full.vert", "void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0.5, 1.0); }"},
    {"two.frag", "void main() { base = vec4(0.25); mask = vec4(0.5); }"},
    {"more.frag", "void main() { extra = texelFetch(mask, ivec2(gl_FragCoord.xy), 0); }"},
    {"tone.comp", "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy); tones[8 * at.y + at.x] = uint(255.0 * texelFetch(mask, at, 0).y); }"},
    {"light.comp",
     "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
     "  imageStore(trail, at, uvec4(texelFetch(trail_prev, at, 0).x + uint(texelFetch(base, at, 0).x) + twins[8 * at.y + at.x])); }"},
    {"mix.comp",
     "void main() { ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
     "  imageStore(seen, at, uvec4(texelFetch(trail, at, 0).x + uint(texelFetch(extra, at, 0).y))); }"},
    {"show.comp", kShowShader}};

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
  const compiler::CompileResult result = compile_files(kDamaged, in_order);
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
