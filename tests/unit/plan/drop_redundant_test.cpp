// What synchronisation has to achieve, derivations of it, and what goes because nothing rests on it.
#include <algorithm>
#include <iterator>

#include "compiler/build_graph.h"
#include "compiler/cull.h"
#include "compiler/epochs.h"
#include "compiler/obligations.h"
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

constexpr dsl::GraphId kGraph{size_t{0}};

// A frame on one queue up to its barriers.
struct Synchronised {
  dsl::Program program;
  Frame frame;
  Schedule schedule;
  std::vector<Line> lines;
  SyncPlan sync;
  explicit Synchronised(const std::string& body) : program(program_of(body)) {
    const PlanOptions options;
    frame = expand(program, kGraph, {}, options);
    const std::vector<bool> live = cull(frame, build_graph(frame, std::vector<bool>(frame.passes.size(), true))).live;
    schedule = make_schedule(frame, build_graph(frame, live), live, separate_renderings(frame), options);
    lines = find_epochs(frame, schedule);
    sync = synchronise(frame, schedule, lines, options);
  }
};

constexpr char kChain[] =
    "image a : rgba16f view\n image b : rgba16f view\n"
    "pass make : compute { write a as storage }\n"
    "pass turn : raster { read a as sampled in fragment  color b clear 0 }\n"
    "pass show : raster { read b as sampled in fragment  color backbuffer clear 0 }\n";

TEST(HappensBefore, EveryFactOfAPlanHasADerivation) {
  const Synchronised made(kChain);
  EXPECT_EQ(made.sync.unproved, 0u);
  HappensBefore order(made.frame, made.schedule, made.sync);
  const Obligations found = find_obligations(made.frame, made.schedule, made.lines, made.sync, order);
  std::vector<SyncAtom> atoms;
  size_t reads = 0;
  for (const SyncFact& fact : found.facts) {
    EXPECT_TRUE(order.derive(fact, atoms) || fact.optional);
    reads += fact.kind == SyncFact::Kind::sees && (fact.access & access::shader_sampled_read);
  }
  EXPECT_EQ(reads, 2u);  // of a and b
}

TEST(HappensBefore, ADerivationRestsOnWhatItNames) {
  const Synchronised made(kChain);
  HappensBefore order(made.frame, made.schedule, made.sync);
  const Obligations found = find_obligations(made.frame, made.schedule, made.lines, made.sync, order);
  const auto sees = std::find_if(found.facts.begin(), found.facts.end(), [](const SyncFact& fact) {
    return fact.kind == SyncFact::Kind::sees && (fact.access & access::shader_sampled_read);
  });
  ASSERT_NE(sees, found.facts.end());
  std::vector<SyncAtom> atoms;
  ASSERT_TRUE(order.derive(*sees, atoms));
  for (const SyncAtom& atom : std::vector<SyncAtom>(atoms)) {
    const SyncScope saved = order.scopes[atom.scope];
    SyncScope& scope = order.scopes[atom.scope];
    const uint64_t bit = uint64_t{1} << atom.bit;
    if (atom.field == AtomField::whole) scope.gone = true;
    if (atom.field == AtomField::dst_stage) scope.dst &= ~bit;
    if (atom.field == AtomField::dst_access) scope.dst_accesses &= ~bit;
    order.refresh(atom.scope);
    // A transition is its own source: without it there is nothing to see.
    EXPECT_FALSE(!scope.gone && order.derive(*sees, atoms)) << static_cast<int>(atom.field);
    scope = saved;
    order.refresh(atom.scope);
  }
  EXPECT_TRUE(order.derive(*sees, atoms));
}

TEST(DropRedundant, WhatIsAddedGoesAgain) {
  Synchronised made(kChain);
  const auto masks = [&] {
    std::vector<uint64_t> all;
    for (const auto& group : made.sync.groups)
      for (const CellBarrier& b : group) all.insert(all.end(), {b.cell, b.src_stages, b.src_accesses, b.dst_stages, b.dst_accesses});
    return all;
  };
  const std::vector<uint64_t> before = masks();
  for (auto& group : made.sync.groups)
    for (CellBarrier& b : group) {
      b.src_stages |= stage::copy, b.src_accesses |= access::transfer_write;
      b.dst_stages |= stage::copy, b.dst_accesses |= access::transfer_read;
    }
  drop_redundant(made.frame, made.schedule, made.lines, made.sync);
  EXPECT_EQ(masks(), before);
}

// Batches wait in the stages that need it, for the signal that covers it, and for nothing that another wait implies.
TEST(DropRedundant, WaitsNameWhatTheyAreFor) {
  PlanOptions options;
  options.queues = {dsl::QueueKind::graphics, dsl::QueueKind::compute};
  const FramePlan frame = plan_of(
      "buffer a : u32[64]\n buffer b : u32[64]\n"
      "pass first : compute { write a as storage }\n"
      "pass second : compute queue compute { read a as storage  write b as storage }\n"
      "pass third : raster { read b as storage in vertex  read a as storage in fragment  color backbuffer clear 0 }\n",
      options);
  EXPECT_EQ(frame.unproved, 0u);
  const PlanData& plan = frame.plan;
  std::vector<Wait> waits;
  std::copy_if(plan.waits.begin(), plan.waits.end(), std::back_inserter(waits), [](const Wait& wait) { return wait.frames_ago == 0; });
  ASSERT_EQ(waits.size(), 2u);
  EXPECT_EQ(waits[0].stages, stage::compute_shader);
  EXPECT_EQ(waits[1].stages, stage::vertex_shader);
  EXPECT_EQ(plan.signals[0].stages, stage::compute_shader);
}

}  // namespace
}  // namespace rg::compiler
