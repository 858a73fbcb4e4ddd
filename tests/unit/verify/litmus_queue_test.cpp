// Litmus cases on several queues: semaphores, order of submission, what a queue can run.
#include "tests/unit/verify/litmus_queue.h"

namespace rg::verify {
namespace {

const Litmus kQueueCases[] = {
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
};

class QueueLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(QueueLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, QueueLitmus, ::testing::ValuesIn(kQueueCases), litmus_name);

}  // namespace
}  // namespace rg::verify
