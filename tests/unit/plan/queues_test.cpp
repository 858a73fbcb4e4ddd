// Several queues: the model of time, what moves and why, batches, waits, ownership and shared memory across queues.
#include "compiler/pass_cost.h"
#include "compiler/queue_timeline.h"
#include "runtime/alias.h"
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

// 0 -> 1 -> 3 and 0 -> 2 -> 3; node 2 may run on queue 1.
QueueProblem diamond(double side) {
  QueueProblem problem;
  problem.queues = 2, problem.groups = 1, problem.wait = 1;
  problem.nodes = {{10}, {side}, {side, 0, 1, 0}, {10}};
  problem.edges = {{0, 1}, {0, 2}, {1, 3}, {2, 3}};
  return problem;
}

TEST(QueueTimeline, QueuesRunSideBySide) {
  const QueueProblem problem = diamond(50);
  EXPECT_EQ(simulate(problem, {0, 0, 0, 0}).end, 120);
  const QueueTimeline timeline = simulate(problem, {0, 0, 1, 0});
  EXPECT_EQ(timeline.start[2], 11);  // one wait after node 0
  EXPECT_EQ(timeline.end, 72);       // and one more before node 3
  EXPECT_EQ(timeline.order, (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST(QueueTimeline, MovesOnlyWhatIsWorthIt) {
  const QueueChoice far = choose_queues(diamond(50), 1, 1000);
  EXPECT_EQ(far.queue_of, (QueueOf{0, 0, 1, 0}));
  EXPECT_EQ(far.gain.serial, 120);
  EXPECT_EQ(far.gain.critical_path, 70);
  EXPECT_EQ(far.gain.bound, 70);
  EXPECT_EQ(far.gain.end, 72);
  EXPECT_EQ(far.worth[2], 48);
  EXPECT_EQ(choose_queues(diamond(2), 1, 1000).queue_of, (QueueOf{0, 0, 0, 0}));    // less than its waits
  EXPECT_EQ(choose_queues(diamond(50), 60, 1000).queue_of, (QueueOf{0, 0, 0, 0}));  // less than the whole has to gain
}

TEST(QueueTimeline, RunsAheadWithinTheWindowOnly) {
  QueueProblem problem;
  problem.queues = 2, problem.groups = 1, problem.wait = 0;
  problem.nodes = {{10}, {50, 1}, {5}, {5}, {5}};  // 2 needs 1; 3 and 4 need nobody
  problem.edges = {{0, 1}, {1, 2}};
  const QueueOf queues = {0, 1, 0, 0, 0};
  EXPECT_EQ(simulate(problem, queues).start[3], 10);
  EXPECT_EQ(simulate(problem, queues).start[4], 15);
  problem.window = 1;
  EXPECT_EQ(simulate(problem, queues).start[3], 10);
  EXPECT_EQ(simulate(problem, queues).start[4], 65);  // two behind node 2, which waits
}

// Shadows and light culling have nothing in common until the light.
constexpr char kOverlap[] =
    "image depth : d32f view\n image shadow : d32f view\n image occlusion : r8 view\n image blurred : r8 view\n"
    "pass prepass : raster { depth depth clear 0.0  draw host {} }\n"
    "pass occlude : compute queue compute may { read depth as sampled  write occlusion as storage }\n"
    "pass blur : compute queue compute may { read occlusion as sampled  write blurred as storage }\n"
    "pass shadows : raster { depth shadow clear 0.0  draw host {} }\n"
    "pass light : raster { read depth as sampled in fragment  read shadow as sampled in fragment  read blurred as sampled in fragment\n"
    "  color backbuffer covers }\n";

const PlanOptions kTwo = {.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute},
                          .measured_us = {{"prepass", 50}, {"occlude", 100}, {"blur", 100}, {"shadows", 250}, {"light", 100}}};

TEST(Queues, OverlapIsPlannedWhereItPays) {
  const FramePlan frame = plan_of(kOverlap, kTwo);
  ASSERT_EQ(frame.plan.queues.size(), 2u);
  EXPECT_EQ(frame.overlap.moved, 2u);
  EXPECT_EQ(pass_named(frame.plan, "occlude").queue, 1u);
  EXPECT_EQ(pass_named(frame.plan, "shadows").queue, 0u);
  EXPECT_EQ(frame.overlap.serial, 600'000);
  EXPECT_EQ(frame.overlap.bound, 400'000);
  EXPECT_LE(frame.overlap.end, 420'000);
  PlanOptions one = kTwo;
  one.async = false;
  EXPECT_EQ(plan_of(kOverlap, one).plan.queues.size(), 1u);
  one = kTwo;
  one.no_async = {"occlude", "blur"};
  EXPECT_EQ(plan_of(kOverlap, one).plan.queues.size(), 1u);
}

// Four passes without a barrier between them: the one that the compute queue waits for comes last as written, and has to be first.
constexpr char kLate[] =
    "image a : d32f view\n image b : d32f view\n image c : d32f view\n image source : d32f view\n image found : r8 view\n"
    "pass draw_a : raster { depth a clear 0.0  draw host {} }\n"
    "pass draw_b : raster { depth b clear 0.0  draw host {} }\n"
    "pass draw_c : raster { depth c clear 0.0  draw host {} }\n"
    "pass draw_source : raster { depth source clear 0.0  draw host {} }\n"
    "pass find : compute queue compute may { read source as sampled  write found as storage }\n"
    "pass light : raster { read a as sampled in fragment  read b as sampled in fragment  read c as sampled in fragment\n"
    "  read found as sampled in fragment  color backbuffer covers }\n";

TEST(Queues, WhatAQueueWaitsForIsHurried) {
  PlanOptions options = {.queues = kTwo.queues,
                         .measured_us = {{"draw_a", 100}, {"draw_b", 100}, {"draw_c", 100}, {"draw_source", 50}, {"find", 250}, {"light", 100}}};
  const FramePlan frame = plan_of(kLate, options);
  EXPECT_EQ(frame.overlap.moved, 1u);
  EXPECT_EQ(frame.overlap.bound, 450'000);
  EXPECT_LE(frame.overlap.end, 460'000);
  EXPECT_EQ(frame.plan.passes[frame.plan.steps[1].index].name, "draw_source");
  options.reorder = false;
  EXPECT_EQ(plan_of(kLate, options).overlap.moved, 0u);  // as written it would be too late
}

TEST(Queues, BatchesAreListedInAnOrderThatRuns) {
  const PlanData plan = plan_of(kOverlap, kTwo).plan;
  std::vector<uint64_t> signalled(plan.queues.size());
  for (const Batch& batch : plan.batches) {
    for (Index w = batch.first_wait; w < batch.first_wait + batch.wait_count; ++w)
      EXPECT_TRUE(plan.waits[w].frames_ago == 1 || plan.waits[w].value <= signalled[plan.waits[w].queue]);
    for (Index s = batch.first_signal; s < batch.first_signal + batch.signal_count; ++s) EXPECT_EQ(plan.signals[s].value, ++signalled[batch.queue]);
  }
  for (const Wait& wait : plan.waits) {
    EXPECT_EQ(wait.stages & stage::all_commands, 0u);
    EXPECT_TRUE(wait.frames_ago == 0 || wait.value == signalled[wait.queue]) << "the end of that queue's frame";
  }
}

TEST(Queues, OneOwnerAtATimeAndSharedReaders) {
  const PlanData plan = plan_of(kOverlap, kTwo).plan;
  EXPECT_TRUE(plan.resources[resource_named(plan, "depth")].concurrent);     // read by occlude and light side by side
  EXPECT_FALSE(plan.resources[resource_named(plan, "blurred")].concurrent);  // handed over
  std::vector<const ImageBarrier*> halves;
  for (const ImageBarrier& b : plan.image_barriers)
    if (b.src_queue != b.dst_queue) halves.push_back(&b);
  ASSERT_EQ(halves.size(), 2u);
  for (const ImageBarrier* half : halves) {
    EXPECT_EQ(half->image.resource, resource_named(plan, "blurred"));
    EXPECT_EQ(half->src_queue, 1u);
    EXPECT_EQ(half->dst_queue, 0u);
    EXPECT_EQ(half->old_layout, Layout::general);
    EXPECT_EQ(half->new_layout, Layout::shader_read_only);
  }
  EXPECT_EQ(halves[0]->range, halves[1]->range);
  EXPECT_EQ(halves[1]->src_accesses, access::none);  // the wait before it has made the write visible
}

// `fog` reads the engine's image; what stands in braces is how that comes and goes.
FramePlan with_engine_image(const std::string& state) {
  return plan_of(
      program_of_text("module m\nextent view = runtime(64, 64) max(128, 128)\ninterface World { maps: image rgba8 view " + state +
                      " }\n"
                      "graph g(world: World, surface backbuffer: rgba8 view after copy_src) {\n"
                      "  image fogged : r8 view\n  image depth : d32f view\n  image shadow : d32f view\n"
                      "  pass prepass : raster { depth depth clear 0.0  draw host {} }\n"
                      "  pass fog : compute queue compute may { read world.maps as sampled  read depth as sampled  write fogged as storage }\n"
                      "  pass shadows : raster { depth shadow clear 0.0  draw host {} }\n"
                      "  pass light : raster { read world.maps as sampled in fragment  read fogged as sampled in fragment\n"
                      "    read shadow as sampled in fragment  color backbuffer covers }\n}\n"),
      {.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute},
       .measured_us = {{"prepass", 50}, {"fog", 200}, {"shadows", 250}, {"light", 100}}});
}

TEST(Queues, ImagesOfTheEngineAreSharedWhereNobodyChangesTheirLayout) {
  const FramePlan ready = with_engine_image("ready as sampled in compute, fragment");
  EXPECT_EQ(pass_named(ready.plan, "fog").queue, 1u);
  EXPECT_TRUE(ready.plan.resources[resource_named(ready.plan, "world.maps")].concurrent);
  for (const ImageBarrier& b : ready.plan.image_barriers) EXPECT_NE(b.image.resource, resource_named(ready.plan, "world.maps"));
  const FramePlan changed = with_engine_image("written as storage in compute after sampled in fragment");
  EXPECT_EQ(pass_named(changed.plan, "fog").queue, 0u) << "the engine's layout is another one";
}

TEST(Queues, MemoryGoesOnlyToWhoeverComesAfter) {
  const PlanData plan = plan_of(kOverlap, kTwo).plan;
  const Plan view = plan.view();
  const alias::Sharing sharing(view);
  const auto share = [&](const char* a, const char* b) { return sharing.may_share(resource_named(plan, a), resource_named(plan, b)); };
  EXPECT_FALSE(share("shadow", "occlusion"));  // side by side on two queues
  EXPECT_FALSE(share("depth", "occlusion"));
  EXPECT_FALSE(share("occlusion", "blurred"));
  for (Index a = 0; a < plan.resources.size(); ++a)
    for (Index b = a + 1; b < plan.resources.size(); ++b) {
      const Resource &x = plan.resources[a], &y = plan.resources[b];
      if (x.lifetime != rg::Lifetime::transient || y.lifetime != rg::Lifetime::transient || sharing.may_share(a, b)) continue;
      EXPECT_TRUE(x.estimated_offset + x.estimated_bytes <= y.estimated_offset || y.estimated_offset + y.estimated_bytes <= x.estimated_offset)
          << x.name << " " << y.name;
    }
}

// What `waste` wrote last is over when the other queue starts, but only a signal that names its stage says so: `blurred` takes its memory then.
TEST(Queues, SignalsNameWhatMemoryNeeds) {
  const char* body =
      "image dead : rgba16f 1024x1024\n image drawn : rgba16f 1024x1024\n image blurred : rgba16f 1024x1024\n image long : rgba16f 2048x1024\n"
      "pass waste : compute { write dead as storage  keep }\n"
      "pass draw : raster { color drawn clear 0  draw host {} }\n"
      "pass blur : compute queue compute may { read drawn as sampled  write blurred as storage  after waste }\n"
      "pass meanwhile : raster { color long clear 0  draw host {} }\n"
      "pass show : raster { read blurred as sampled in fragment  read long as sampled in fragment  color backbuffer clear 0  draw host {} }\n";
  const FramePlan frame = plan_of(body, kTwo);
  ASSERT_EQ(pass_named(frame.plan, "blur").queue, 1u);
  const Plan view = frame.plan.view();
  EXPECT_TRUE(alias::Sharing(view).may_share(resource_named(frame.plan, "dead"), resource_named(frame.plan, "blurred")));
  EXPECT_EQ(frame.heap_bytes, frame.lower_bound_bytes);
  const Batch& first = frame.plan.batches[0];
  EXPECT_NE(frame.plan.signals[first.first_signal].stages & stage::compute_shader, 0u);
  EXPECT_EQ(frame.unproved, 0u);
  PlanOptions alone = kTwo;
  alone.aliasing = false;
  const FramePlan apart = plan_of(body, alone);
  EXPECT_EQ(apart.plan.signals[apart.plan.batches[0].first_signal].stages & stage::compute_shader, 0u) << "nothing to take over, nothing to name";
}

// `show` waits for the other queue in its fragment shader. The hand-off to `second` names depth tests, the later of which come after that: it goes on
// after the wait.
TEST(Queues, MemoryGoesToStagesAfterAWait) {
  const FramePlan frame = plan_of(
      "image drawn : rgba16f 1024x1024\n image blurred : r8 view\n image meant : rgba16f 2048x1024\n image shown : r8 view\n image second : d32f "
      "1024x1024\n"
      "pass draw : raster { color drawn clear 0  draw host {} }\n"
      "pass blur : compute queue compute may { read drawn as sampled  write blurred as storage }\n"
      "pass meanwhile : raster { color meant clear 0  draw host {} }\n"
      "pass show : raster { read blurred as sampled in fragment  read meant as sampled in fragment  color shown clear 0  draw host {} }\n"
      "pass again : raster { read shown as sampled in fragment  depth second clear 0.0  draw host {} }\n"
      "pass last : raster { read second as sampled in fragment  color backbuffer clear 0  draw host {} }\n",
      kTwo);
  ASSERT_EQ(pass_named(frame.plan, "blur").queue, 1u);
  const Plan view = frame.plan.view();
  const Index second = resource_named(frame.plan, "second");
  EXPECT_TRUE(alias::Sharing(view).may_share(resource_named(frame.plan, "drawn"), second));
  EXPECT_EQ(alias::Sharing(view).acquire(second)->stages & stage::fragment_shader, 0u);
  for (const Wait& wait : frame.plan.waits) EXPECT_EQ(wait.stages & (stage::early_fragment_tests | stage::late_fragment_tests), 0u);
  EXPECT_EQ(frame.unproved, 0u);
}

TEST(PassCost, MeasuredTimesReplaceEstimates) {
  const FramePlan estimated = plan_of(kOverlap, {.queues = kTwo.queues});
  EXPECT_GT(estimated.overlap.serial, 5 * kLaunchNs);
  EXPECT_NE(estimated.overlap.serial, 600'000);
}

TEST(PassCost, ProfilesAreReadOrRefused) {
  const Profile good = parse_profile(R"({"schema": "rgc-profile-1", "graph": "frame", "passes_us": {"light": 2.5}})");
  EXPECT_EQ(good.wrong, "");
  EXPECT_EQ(good.passes_us.at("light"), 2.5);
  for (const char* text :
       {"", "[]", "{}", R"({"schema": "rgc-profile-1"})", R"({"schema": "rgc-profile-1", "graph": "frame", "passes_us": {"a": -1}})",
        R"({"schema": "rgc-profile-1", "graph": "frame", "passes_us": {"a": "x"}})"})
    EXPECT_NE(parse_profile(text).wrong, "") << text;
}

}  // namespace
}  // namespace rg::compiler
