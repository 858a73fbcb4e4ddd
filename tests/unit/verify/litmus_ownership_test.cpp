// Litmus cases on several queues: ownership of queue families, frames after frames, shared memory.
#include "tests/unit/verify/litmus_queue.h"

namespace rg::verify {
namespace {

const Litmus kOwnershipCases[] = {
    {"OwnershipTransferred", "Queue Family Ownership Transfer: release, semaphore, acquire", {}, [](Builder& b) { moved_image(b); }},
    {"TransferOfBuffer",
     "Queue Family Ownership Transfer: buffers alike",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.buffer("x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
       b.give(x, kGraphics, Layout::undefined, Layout::undefined, kCs, kWrite, kCs);
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.take(x, kCompute, Layout::undefined, Layout::undefined, kCs, kCs, kRead);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"ReleaseLeadsToAllCommands",
     "VK_PIPELINE_STAGE_2_ALL_COMMANDS: a signal for all commands follows the release, though it names no second stage",
     {},
     [](Builder& b) {
       moved_image(b);
       b.plan.image_barriers[1].dst_stages = 0;
       b.plan.signals[0].stages = kAll;
     }},
    {"ReleaseLeadsNowhere",
     "Queue Family Ownership Transfer: the release happens before what its second scope names, here nothing",
     {"write-after-write"},
     [](Builder& b) {
       moved_image(b);
       b.plan.image_barriers[1].dst_stages = 0;
     }},
    {"AcquireDoesNotWait",
     "Queue Family Ownership Transfer: the release must happen before the acquire",
     {"write-after-write"},
     [](Builder& b) {
       moved_image(b);
       b.plan.image_barriers[2].src_stages = 0;
     }},
    {"NoTransfer",
     "Resource Sharing Mode: contents of an exclusive range are undefined to other families without a transfer",
     {"ownership"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.buffer("x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"AcquireWithoutRelease",
     "Queue Family Ownership Transfer: without a release the acquired contents are undefined",
     {"ownership"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.buffer("x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.take(x, kCompute, Layout::undefined, Layout::undefined, kCs, kCs, kRead);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"ReleaseWithoutAcquire",
     "Queue Family Ownership Transfer: between release and acquire nobody may use the range",
     {"ownership"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.buffer("x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
       b.give(x, kGraphics, Layout::undefined, Layout::undefined, kCs, kWrite, kCs);
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"TransferLayoutsDiffer",
     "VUID of ownership transfers: release and acquire name the same layouts",
     {"ownership", "wrong layout"},
     [](Builder& b) { moved_image(b, Layout::general, Layout::transfer_src); }},
    {"TransferQueuesDiffer",
     "Queue Family Ownership Transfer: both halves name the same families",
     {"ownership", "wrong layout"},
     [](Builder& b) {
       moved_image(b);
       b.plan.image_barriers[1].dst_queue = b.queue(QueueKind::transfer);
     }},
    {"TransferRangesDiffer",
     "Queue Family Ownership Transfer: both halves name the same range",
     {"boundary mismatch", "ownership"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.image("x", Format::rgba16f, 2);
       b.batch(kCompute);
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.give(x, kGraphics, Layout::general, Layout::shader_read_only, kCs, kWrite, kCs);
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kFragment);
       b.take(x, kCompute, Layout::general, Layout::shader_read_only, kFragment, kFragment, ac::shader_sampled_read);
       b.plan.image_barriers.back().range.mips = 1;
       b.raster("r", {reads(x, Role::sampled, kFs).mip(0)});
       b.signal(kAll);
     }},
    {"DiscardNeedsNoTransfer",
     "Queue Family Ownership Transfer: where contents are not kept, no transfer is needed",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = b.image("x");
       b.batch(kCompute);
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.image_barrier(x, Layout::undefined, Layout::general, kCs, 0, kCs, kWrite);
       b.compute("v", {writes(x)});
       b.signal(kAll);
     }},
    {"OneFamilyNeedsNoTransfer",
     "Resource Sharing Mode: queues of one family share exclusive resources",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const Index third = b.queue(QueueKind::compute);
       const auto x = b.buffer("x");
       write_on(b, kCompute, x);
       b.batch(third);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"TransferOfShared",
     "VUID-VkBufferMemoryBarrier2-buffer-04088: concurrent resources are not transferred",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = moved_image(b);
       b.planned(x).concurrent = true;
     }},
    {"UnitedFamiliesNeedTheSignal",
     "where both queues are of one family the release is not recorded: the signal alone must make the writes available",
     {"write-after-write"},
     [](Builder& b) {
       moved_image(b);
       b.plan.image_barriers[1].dst_stages = stage::copy;
       b.plan.signals[0].stages = stage::copy;
       end_on(b, kCompute);
     }},
    {"FrameBefore",
     "Timeline semaphores: a wait for the value of the frame before orders its accesses",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       keep(b, x, state(kCompute, kCs, kRead));
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs, 1);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"FrameBeforeNotAwaited",
     "frames are not ordered on different queues",
     {"write-after-read"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       keep(b, x, state(kCompute, kCs, kRead));
       b.batch(kGraphics);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"FrameBeforeTooEarly",
     "the value of the frame before is signalled before the access: right after another plan, wrong after this one",
     {"write-after-read"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x"), y = shared(b, "y");
       keep(b, x, state(kCompute, kCs, kRead));
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs, 1);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       write_on(b, kCompute, y);
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"LeftOnAnotherQueue",
     "the state at the end of a frame names the queue that still works",
     {"boundary mismatch", "write-after-read"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       keep(b, x, state(kGraphics, kCs, kRead));
       b.batch(kGraphics);
       b.memory(kCs, 0, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"ImportOnAnotherQueue",
     "what the engine does between frames is before no signal of the frame before",
     {"write-after-read", "write-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.source(x).before = {Role::storage, dsl::stage_compute, true};
       b.boundary(x, state(kCompute, kCs, kWrite), state(kGraphics, kAll, ac::memory_read | ac::memory_write));
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs, 1);
       b.compute("w", {writes(x)});
       b.signal(kAll);
       b.batch(kCompute);
       b.signal(kAll);
     }},
    {"SwappedAcrossQueues",
     "program order: without a race, the read still has another version than the program gives it",
     {"poison read"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x"), out = shared(b, "out");
       b.source(out).is_output = true;
       b.lifetime(x, dsl::Lifetime::transient);
       b.boundary(x, state(kCompute, kCs, kWrite), state(kCompute, kCs, kWrite));
       for (auto* rows : {&b.plan.entry, &b.plan.exit}) {
         rows->back().discard = true;
         rows->push_back(rows->back());
         rows->back().queue = kGraphics;
       }
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs, 1);
       b.memory(kCs, kWrite, kCs, kRead | kWrite);
       b.compute("w", {writes(x)});
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x), writes(out)});
       b.signal(kAll);
       end_on(b, kCompute);
       std::swap(b.plan.steps[1], b.plan.steps[2]);
       for (dsl::Pass& pass : b.graph().passes.rows) pass.queue = dsl::QueueKind::compute, pass.queue_may = true;
     }},
    {"MemoryTakenOverAcrossQueues",
     "Memory aliasing: a semaphore orders the users of one resource before those of the other",
     {},
     [](Builder& b) { shared_memory(b); }},
    {"ClockWithoutWait",
     "Memory aliasing: nothing orders the frame before on the other queue",
     {"alias race"},
     [](Builder& b) { shared_memory(b, kCs, kCs, false); }},
    {"ClockThroughAnotherStage",
     "Memory aliasing: the signal does not hold the stage in which the last user works",
     {"alias race"},
     [](Builder& b) { shared_memory(b, stage::copy, kCs); }},
    {"ClockThroughAnotherWait",
     "Memory aliasing: the wait does not hold back the stages of the first user",
     {"alias race"},
     [](Builder& b) { shared_memory(b, kCs, stage::copy); }},
    {"ClockOfTheWrongPoint",
     "Memory aliasing: a release after the point that is waited for is not over",
     {"alias race"},
     [](Builder& b) {
       shared_memory(b);
       b.plan.releases[0].point = 2;
       b.plan.alias_clocks[5] = 2;
     }},
    {"DeclaredOrderAcrossQueues",
     "`after` orders passes on different queues only through a semaphore",
     {"order"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x"), y = shared(b, "y");
       b.batch(kCompute);
       const auto first = b.compute("first", {writes(x)});
       b.signal(kAll);
       b.batch(kGraphics);
       const auto second = b.compute("second", {writes(y)});
       b.graph().passes[second].after = {first};
       b.signal(kAll);
     }},
};

class OwnershipLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(OwnershipLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, OwnershipLitmus, ::testing::ValuesIn(kOwnershipCases), litmus_name);

}  // namespace
}  // namespace rg::verify
