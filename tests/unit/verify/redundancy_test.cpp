// Atoms that nothing needs are reported, and only those: small plans by hand.
#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

constexpr Stages kCs = stage::compute_shader;
constexpr Accesses kRead = access::shader_storage_read, kWrite = access::shader_storage_write;

std::vector<std::string> redundant(Builder& b) {
  std::vector<std::string> texts;
  for (const Finding& finding : b.check(true)) {
    EXPECT_EQ(finding.hazard, Hazard::redundant) << finding.text;
    texts.push_back(finding.text);
  }
  return texts;
}
using Texts = std::vector<std::string>;

TEST(Redundancy, ExactBarrierIsNeeded) {
  Builder b;
  const auto x = b.buffer("x");
  b.compute("w", {writes(x)});
  b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
  b.compute("r", {reads(x)});
  EXPECT_EQ(redundant(b), Texts{});
}

TEST(Redundancy, BarrierThatNothingNeeds) {
  Builder b;
  const auto x = b.buffer("x"), y = b.buffer("y");
  b.compute("w", {writes(x)});
  b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
  b.buffer_barrier(y, kCs, kWrite, kCs, kRead, true);
  b.compute("r", {reads(x)});
  EXPECT_EQ(redundant(b), Texts{"buffer barrier 1 on `y` can be removed"});
}

TEST(Redundancy, EachBitIsAnAtom) {
  Builder b;
  const auto x = b.buffer("x");
  b.compute("w", {writes(x)});
  b.buffer_barrier(x, kCs | st::copy, kWrite | ac::transfer_write, kCs | st::fragment_shader, kRead | ac::uniform_read);
  b.compute("r", {reads(x)});
  EXPECT_EQ(redundant(b), (Texts{"buffer barrier 0 on `x`: source stage copy can be removed",
                                 "buffer barrier 0 on `x`: source access transfer_write can be removed",
                                 "buffer barrier 0 on `x`: destination stage fragment_shader can be removed",
                                 "buffer barrier 0 on `x`: destination access uniform_read can be removed"}));
}

TEST(Redundancy, WriteAfterReadNeedsNoAccess) {
  Builder b;
  const auto x = b.buffer("x");
  b.compute("r", {reads(x)});
  b.buffer_barrier(x, kCs, kWrite, st::copy, ac::transfer_write);
  b.transfer("w", {writes(x, Role::copy_dst)});
  EXPECT_EQ(redundant(b), (Texts{"buffer barrier 0 on `x`: source access shader_storage_write can be removed",
                                 "buffer barrier 0 on `x`: destination access transfer_write can be removed"}));
}

// Either of two equal barriers can go, so both are named.
TEST(Redundancy, TwoBarriersForOneHazard) {
  Builder b;
  const auto x = b.buffer("x");
  b.compute("w", {writes(x)});
  b.memory(kCs, kWrite, kCs, kRead);
  b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
  b.compute("r", {reads(x)});
  EXPECT_EQ(redundant(b), (Texts{"memory barrier 0 can be removed", "buffer barrier 0 on `x` can be removed"}));
}

// A barrier on another buffer already orders execution.
TEST(Redundancy, ExecutionThroughASibling) {
  Builder b;
  const auto x = b.buffer("x"), y = b.buffer("y");
  b.transfer("w", {writes(y, Role::copy_dst), reads(x, Role::copy_src)});
  b.buffer_barrier(y, st::copy, ac::transfer_write, kCs, kRead);
  b.buffer_barrier(x, st::copy, 0, kCs, 0, true);
  b.compute("r", {reads(y), writes(x)});
  EXPECT_EQ(redundant(b), Texts{"buffer barrier 1 on `x` can be removed"});
}

// Both links of a chain are needed.
TEST(Redundancy, ChainLinks) {
  Builder b;
  const auto x = b.buffer("x");
  b.compute("w", {writes(x)});
  b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
  b.compute("r1", {reads(x)});
  b.buffer_barrier(x, kCs, 0, st::fragment_shader, kRead);
  b.raster("r2", {reads(x, Role::storage, kFs)});
  EXPECT_EQ(redundant(b), Texts{});
}

TEST(Redundancy, TransitionIsNeededForItsLayout) {
  Builder b;
  const auto x = b.image("x");
  b.start(x, Layout::general, kCs, kWrite);
  b.compute("w", {writes(x)});
  b.image_barrier(x, Layout::general, Layout::shader_read_only, kCs, kWrite, kCs, ac::shader_sampled_read);
  b.compute("r", {reads(x, Role::sampled)});
  EXPECT_EQ(redundant(b), Texts{});
}

TEST(Redundancy, TaggedAtomsNeedNoHazard) {
  for (const BarrierTag tag :
       {BarrierTag::valid_usage, BarrierTag::workaround, BarrierTag::merged_batch, BarrierTag::boundary_join, BarrierTag::alias_pair}) {
    Builder b;
    const auto x = b.buffer("x"), y = b.buffer("y");
    b.compute("w", {writes(x)});
    b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
    b.buffer_barrier(y, kCs, kWrite, kCs, kRead, true);
    b.plan.buffer_barriers[1].tag = tag;
    b.compute("r", {reads(x)});
    EXPECT_EQ(redundant(b), Texts{});
  }
}

// Without the reader, the second write follows the first: its visibility is needed.
TEST(Redundancy, ReaderThatMayBeSkippedOrdersNothing) {
  for (const bool skipped : {false, true}) {
    Builder b;
    const auto x = b.buffer("x");
    b.compute("w", {writes(x)});
    b.buffer_barrier(x, kCs, kWrite, kCs, kRead);
    const auto reader = b.compute("r", {reads(x)});
    if (skipped) b.condition(reader, "sometimes");
    b.buffer_barrier(x, kCs, 0, kCs, kWrite);
    b.compute("w2", {writes(x)});
    const Texts bit{"buffer barrier 1 on `x`: destination access shader_storage_write can be removed"};
    EXPECT_EQ(redundant(b), skipped ? Texts{} : bit);
  }
}

// ---- several queues ---------------------------------------------------------------------------------------------

constexpr Stages kAll = stage::all_commands;

dsl::ResourceId shared(Builder& b, const std::string& name) {
  const auto id = b.buffer(name);
  b.planned(id).concurrent = true;
  return id;
}

// `w` on queue 1, `r` on queue 0 after it.
void write_then_read(Builder& b, Stages signal, Stages wait) {
  const Index compute = b.queue(QueueKind::compute);
  const auto x = shared(b, "x");
  b.batch(compute);
  b.compute("w", {writes(x)});
  b.signal(signal);
  b.batch(compute);
  b.signal(kAll);
  b.batch(0);
  b.wait(compute, 1, wait);
  b.compute("r", {reads(x)});
  b.signal(kAll);
}

TEST(Redundancy, ExactSemaphoreIsNeeded) {
  Builder b;
  write_then_read(b, kCs, kCs);
  EXPECT_EQ(redundant(b), Texts{});
}

TEST(Redundancy, BitsOfSemaphores) {
  Builder b;
  write_then_read(b, kCs | st::copy, kCs | st::copy);
  EXPECT_EQ(redundant(b), (Texts{"signal 0 of queue 1 (compute): source stage copy can be removed",
                                 "wait 0 of queue 0 (graphics): destination stage copy can be removed"}));
}

TEST(Redundancy, WaitForMoreThanNeeded) {
  Builder b;
  write_then_read(b, kCs, kCs);
  b.plan.waits[0].value = 2;
  EXPECT_EQ(redundant(b), (Texts{"signal 0 of queue 1 (compute) can be removed", "wait 0 of queue 0 (graphics): it could wait for value 1"}));
}

TEST(Redundancy, WaitThatNothingNeeds) {
  Builder b;
  const Index compute = b.queue(QueueKind::compute);
  const auto x = shared(b, "x"), y = shared(b, "y");
  b.batch(compute);
  b.compute("w", {writes(x)});
  b.signal(kAll);
  b.batch(0);
  b.wait(compute, 1, kCs);
  b.compute("v", {writes(y)});
  b.signal(kAll);
  EXPECT_EQ(redundant(b), Texts{"wait 0 of queue 0 (graphics) can be removed"});
}

// Queue 0 waits for queue 2, which has waited for queue 1.
TEST(Redundancy, WaitImpliedByAnother) {
  Builder b;
  const Index compute = b.queue(QueueKind::compute), third = b.queue(QueueKind::compute);
  const auto x = shared(b, "x"), y = shared(b, "y");
  b.batch(compute);
  b.compute("w", {writes(x)});
  b.signal(kCs);
  b.batch(third);
  b.wait(compute, 1, kCs);
  b.compute("v", {reads(x), writes(y)});
  b.signal(kCs);
  b.batch(0);
  b.wait(compute, 1, kCs);
  b.wait(third, 1, kCs);
  b.compute("r", {reads(x), reads(y)});
  b.signal(kAll);
  EXPECT_EQ(redundant(b), Texts{"wait 1 of queue 0 (graphics) can be removed"});
}

TEST(Redundancy, SecondWaitOfOneQueue) {
  Builder b;
  write_then_read(b, kCs, kCs);
  const auto y = shared(b, "y");
  b.plan.signals.back().stages = kCs;
  b.batch(0);
  b.wait(1, 1, kCs);
  b.compute("v", {reads(dsl::ResourceId{size_t{0}}), writes(y)});
  b.signal(kAll);
  EXPECT_EQ(redundant(b), (Texts{"signal 2 of queue 0 (graphics) can be removed", "wait 1 of queue 0 (graphics) can be removed"}));
}

}  // namespace
}  // namespace rg::verify
