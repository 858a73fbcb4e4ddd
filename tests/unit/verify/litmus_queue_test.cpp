// Litmus cases on several queues: semaphores, ownership, order of submission.
#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

constexpr Stages kCs = stage::compute_shader, kFragment = stage::fragment_shader, kAll = stage::all_commands;
constexpr Accesses kRead = access::shader_storage_read, kWrite = access::shader_storage_write;
constexpr Index kGraphics = 0, kCompute = 1;

// Queue 0 is graphics, queue 1 compute.
dsl::ResourceId shared(Builder& b, const std::string& name) {
  const auto id = b.buffer(name);
  b.planned(id).concurrent = true;
  return id;
}

Boundary state(Index queue, Stages stages, Accesses accesses, Layout layout = Layout::undefined) {
  Boundary row;
  row.stages = stages, row.accesses = accesses, row.layout = layout, row.queue = queue;
  return row;
}

// A batch that writes `x` in compute and signals.
void write_on(Builder& b, Index queue, dsl::ResourceId x, Stages signal = kCs) {
  b.batch(queue);
  b.compute("w", {writes(x)});
  b.signal(signal);
}
// The last batch of every queue signals.
void end_on(Builder& b, Index queue) {
  b.batch(queue);
  b.signal(kAll);
}
void read_on(Builder& b, Index queue, dsl::ResourceId x) {
  b.batch(queue);
  b.compute("r", {reads(x)});
  b.signal(kAll);
}

// Persistent from frame to frame, pending on one queue.
void keep(Builder& b, dsl::ResourceId id, const Boundary& at) {
  b.lifetime(id, dsl::Lifetime::persistent);
  b.boundary(id, at, at);
}

// `x` is written on the compute queue and sampled on the graphics queue, after a transfer.
dsl::ResourceId moved_image(Builder& b, Layout given = Layout::general, Layout taken = Layout::general) {
  b.queue(QueueKind::compute);
  const auto x = b.image("x");
  b.batch(kCompute);
  b.start(x, Layout::general, kCs, kWrite);
  b.compute("w", {writes(x)});
  b.give(x, kGraphics, given, Layout::shader_read_only, kCs, kWrite, kCs);
  b.signal(kCs);
  b.batch(kGraphics);
  b.wait(kCompute, 1, kFragment);
  b.take(x, kCompute, taken, Layout::shader_read_only, kFragment, kFragment, ac::shader_sampled_read);
  b.raster("r", {reads(x, Role::sampled, kFs)});
  b.signal(kAll);
  return x;
}

// `a` on the compute queue, then `c` on the graphics queue in the same memory, and `a` again in the next frame.
void shared_memory(Builder& b, Stages signal = kCs, Stages wait = kCs, bool waits_for_frame_before = true) {
  b.queue(QueueKind::compute);
  const auto a = shared(b, "a"), c = shared(b, "c");
  for (const auto id : {a, c}) {
    b.lifetime(id, dsl::Lifetime::transient);
    const Boundary at = state(id == a ? kCompute : kGraphics, kCs, kWrite);
    b.boundary(id, at, at);
    b.plan.entry.back().discard = b.plan.exit.back().discard = true;
    b.planned(id).estimated_bytes = 1024;
  }
  b.batch(kCompute);
  if (waits_for_frame_before) b.wait(kGraphics, 1, kCs, 1);
  b.memory(kCs, kWrite, kCs, kWrite);
  b.compute("wa", {writes(a)});
  b.signal(signal);
  b.batch(kGraphics);
  b.wait(kCompute, 1, wait);
  b.memory(kCs, kWrite, kCs, kWrite);
  b.compute("wc", {writes(c)});
  b.signal(kAll);
  end_on(b, kCompute);
  // Points: queue 1 has its group and two ends of batches, queue 0 its group and one end.
  b.plan.acquires = {{a.value, 0, kNone, 0, kCs, kWrite, kCompute, 0, 0}, {c.value, 1, kNone, 0, kCs, kWrite, kGraphics, 0, 4}};
  b.plan.releases = {{a.value, kCs, kWrite, kCompute, 1}, {c.value, kCs, kWrite, kGraphics, 1}};
  b.plan.alias_clocks = {kNone, 0, 1, 2, 0, 1, 1, 1};
}

const Litmus kCases[] = {
    {"SignalThenWait",
     "Semaphore signal makes all memory accesses of its first scope available; wait makes them visible to its second",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"NoWait",
     "Queue Operation: batches on different queues are unordered without semaphores",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       read_on(b, kGraphics, x);
     }},
    {"BarrierAcrossQueues",
     "Pipeline barrier: both scopes are limited to the queue it was submitted to",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.memory(kCs, kWrite, kCs, kRead);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"SignalInAnotherStage",
     "VkSemaphoreSubmitInfo: the first scope of a signal is limited to stageMask",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x, stage::copy);
       end_on(b, kCompute);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"SignalAfterChain",
     "Execution dependency chain: a barrier leads from the access to the signal's stages",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, stage::copy, 0);
       b.signal(stage::copy);
       end_on(b, kCompute);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitInAnotherStage",
     "VkSemaphoreSubmitInfo: the second scope of a wait is limited to stageMask",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, stage::copy);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitInEarlierStage",
     "Synchronization scopes: a second scope includes logically later stages; its accesses only those named",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, stage::vertex_shader);
       b.raster("r", {reads(x, Role::storage, kFs)});
       b.signal(kAll);
     }},
    {"OverwriteInLaterStage",
     "Write-after-read: execution suffices, and a wait also holds back logically later stages",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.compute("r", {reads(x)});
       b.signal(kAll);
       b.batch(kGraphics);
       b.wait(kCompute, 1, stage::vertex_shader);
       b.raster("w", {writes(x, Role::storage, kFs)});
       b.signal(kAll);
     }},
    {"OverwriteUnordered",
     "Write-after-read needs an execution dependency, on other queues a semaphore",
     {"write-after-read"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       read_on(b, kCompute, x);
       b.batch(kGraphics);
       b.compute("w", {writes(x)});
       b.signal(kAll);
     }},
    {"WriteAfterWriteUnordered",
     "Write-after-write needs a memory dependency, on other queues a semaphore",
     {"write-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x, kAll);
       b.batch(kGraphics);
       b.compute("v", {writes(x)});
       b.signal(kAll);
     }},
    {"BarrierChainsFromWait",
     "Execution dependency chain: a barrier whose first scope holds the wait's stages goes on from it",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, stage::copy);
       b.memory(stage::copy, 0, kCs, kRead);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"BarrierMissesWait",
     "Execution dependency chain: the barrier's first scope does not hold the wait's stages",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, stage::copy);
       b.memory(stage::clear, 0, kCs, kRead);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitHoldsLaterBatches",
     "Semaphore waits: the second scope includes all later commands of the queue",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.signal(kCs);
       read_on(b, kGraphics, x);
     }},
    {"SignalHoldsEarlierBatches",
     "Semaphore signals additionally include all commands earlier in submission order",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
       b.batch(kCompute);
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitForTooEarlySignal",
     "Timeline semaphores: a wait is for its value, later work is not included",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x"), y = shared(b, "y");
       write_on(b, kCompute, y);
       b.batch(kCompute);
       b.compute("w2", {writes(x)});
       b.signal(kAll);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitForLaterSignal",
     "Semaphore signals include all signals earlier in signal operation order",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kCompute);
       b.signal(stage::copy);
       end_on(b, kCompute);
       b.batch(kGraphics);
       b.wait(kCompute, 2, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"OrderedThroughThirdQueue",
     "Execution dependency chain through the semaphores of a third queue",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const Index third = b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(third);
       b.wait(kCompute, 1, kCs);
       b.signal(kCs);
       b.batch(kGraphics);
       b.wait(third, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"ChainBreaksOnThirdQueue",
     "Execution dependency chain: the third queue signals in stages its wait does not hold",
     {"read-after-write"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const Index third = b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(third);
       b.wait(kCompute, 1, stage::copy);
       b.signal(kCs);
       end_on(b, third);
       b.batch(kGraphics);
       b.wait(third, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"WaitBeforeSignal",
     "Timeline semaphores: with one queue, what is waited for must be submitted before",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
       write_on(b, kCompute, x);
     }},
    {"WaitForNothing",
     "VUID-VkSubmitInfo2-semaphore-03881 and common sense: a value that nobody signals never comes",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       b.batch(kGraphics);
       b.wait(kCompute, 2, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"ValuesDescend",
     "VUID-VkSubmitInfo2-semaphore-03882: a signalled value is greater than the current one",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x);
       end_on(b, kCompute);
       b.plan.signals[1].value = 1;
     }},
    {"LastBatchSignalsNothing",
     "VkQueueSubmit2: without a signal nobody learns that the work is over",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
     }},
    {"AllCommandsInTheMiddle",
     "house rule: only the signal that retires the frame stands for all commands",
     {"invalid barrier"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x, kAll);
       end_on(b, kCompute);
       b.batch(kGraphics);
       b.wait(kCompute, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
     }},
    {"GraphicsStageOnComputeQueue",
     "VUID-vkCmdPipelineBarrier2-dstStageMask-03850: stages must be supported by the queue family",
     {"invalid barrier"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, kFragment, kRead);
       b.signal(kAll);
     }},
    {"DispatchOnTransferQueue",
     "vkCmdDispatch: supported queue types are compute",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::transfer);
       const auto x = shared(b, "x");
       write_on(b, kCompute, x, kAll);
     }},
    {"RasterOnComputeQueue",
     "vkCmdBeginRendering: supported queue types are graphics",
     {"submission"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kCompute);
       b.raster("r", {reads(x, Role::uniform, kFs)});
       b.signal(kAll);
     }},
    {"CopyOnTransferQueue",
     "vkCmdCopyBuffer: supported queue types include transfer",
     {},
     [](Builder& b) {
       const Index copies = b.queue(QueueKind::transfer);
       const auto x = shared(b, "x"), y = shared(b, "y");
       b.batch(copies);
       b.transfer("c", {reads(x, Role::copy_src), writes(y, Role::copy_dst)});
       b.signal(kAll);
     }},
    {"OwnershipTransferred",
     "Queue Family Ownership Transfer: release, semaphore, acquire",
     {},
     [](Builder& b) { moved_image(b); }},
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

class QueueLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(QueueLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, QueueLitmus, ::testing::ValuesIn(kCases), litmus_name);

}  // namespace
}  // namespace rg::verify
