// Litmus cases on events: which commands the halves of a split barrier order, and where they may stand.
#include "tests/unit/verify/litmus_queue.h"

namespace rg::verify {
namespace {

void after_write(Builder& b, dsl::ResourceId x, bool join = false) { b.buffer_barrier(x, kCs, kWrite, kCs, kRead, join); }

const Litmus kEventCases[] = {
    {"ReadAfterWaitWriteBeforeSet",
     "vkCmdWaitEvents2: a memory dependency between what is submitted before the set and what is submitted after the wait",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       after_write(b, x);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.compute("r", {reads(x)});
     }},
    {"WriteAfterSet",
     "vkCmdSetEvent2: the first scope is what comes before it in submission order",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("before", {writes(y)});
       after_write(b, x);
       const Index event = b.split();
       b.compute("w", {writes(x)});
       b.await(event);
       b.compute("r", {reads(x)});
     }},
    {"ReadBeforeWait",
     "vkCmdWaitEvents2: the second scope is what comes after it in submission order",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       after_write(b, x);
       const Index event = b.split();
       b.compute("r", {reads(x)});
       b.await(event);
       b.compute("after", {writes(y)});
     }},
    {"WriteAfterReadBetweenHalves",
     "Neither scope holds what stands between set and wait",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.memory(kCs, 0, kCs, 0);
       const Index event = b.split();
       b.compute("again", {reads(x)});
       b.await(event);
       b.compute("w", {writes(x)});
     }},
    {"WriteAfterReadOverEvent",
     "Write-after-read needs an execution dependency only",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("r", {reads(x)});
       b.memory(kCs, 0, kCs, 0);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.compute("w", {writes(x)});
     }},
    {"TransitionBetweenHalves",
     "A layout transition happens between set and wait; both scopes order it",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       const auto y = b.buffer("y");
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::general, Layout::shader_read_only, kCs, kWrite, kFragment, ac::shader_sampled_read);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.raster("r", {reads(x, Role::sampled, kFs)});
     }},
    {"ReadDuringTransition",
     "A transition may happen as soon as its event is set: nobody uses the range before the wait",
     {"read-after-write", "wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::general, Layout::shader_read_only, kCs, kWrite, kFragment, ac::shader_sampled_read);
       const Index event = b.split();
       b.compute("early", {reads(x)});
       b.await(event);
       b.raster("r", {reads(x, Role::sampled, kFs)});
     }},
    {"DiscardDuringRead",
     "A discard may happen as soon as its event is set",
     {"poison read", "read-after-write", "write-after-read"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::undefined, Layout::general, kCs, kWrite, kCs, kWrite);
       const Index event = b.split();
       b.compute("r", {reads(x)});
       b.await(event);
       b.compute("w2", {writes(x)});
     }},
    {"BarrierGoesOnIntoEvent",
     "Dependencies chain where the second scope of the one meets the first scope of the other",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, kFragment, 0);
       b.memory(kFragment, 0, kCs, kRead);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.compute("r", {reads(x)});
     }},
    {"BarrierAfterSetDoesNotGoOn",
     "What comes after the set is in its first scope neither by itself nor by what waits for it",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       b.memory(kFragment, 0, kCs, kRead);
       const Index event = b.split();
       b.memory(kCs, kWrite, kFragment, 0);
       b.compute("between", {writes(y)});
       b.await(event);
       b.compute("r", {reads(x)});
     }},
    {"EventGoesOnIntoBarrier",
     "Dependencies chain from the second scope on, once the event is awaited",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, kFragment, 0);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.memory(kFragment, 0, kCs, kRead);
       b.compute("r", {reads(x)});
     }},
    {"EventDoesNotGoOnBeforeItsWait",
     "The second scope of an event begins at its wait",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, kFragment, 0);
       const Index event = b.split();
       b.memory(kFragment, 0, kCs, kRead);
       b.compute("r", {reads(x)});
       b.await(event);
       b.compute("after", {writes(y)});
     }},
    {"TwoEventsCross",
     "Each event has scopes of its own",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("wx", {writes(x)});
       after_write(b, x);
       const Index first = b.split();
       b.compute("wy", {writes(y)});
       after_write(b, y);
       const Index second = b.split();
       b.await(first);
       b.compute("rx", {reads(x)});
       b.await(second);
       b.compute("ry", {reads(y)});
     }},
    {"SignalComesAfterWait",
     "A batch is over when its waits for events are",
     {},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x"), y = shared(b, "y");
       b.batch(kGraphics);
       b.compute("w", {writes(x)});
       b.buffer_barrier(x, kCs, kWrite, kFragment, 0);
       const Index event = b.split();
       b.compute("between", {writes(y)});
       b.await(event);
       b.signal(kFragment);
       b.batch(kCompute);
       b.wait(kGraphics, 1, kCs);
       b.compute("r", {reads(x)});
       b.signal(kAll);
       end_on(b, kGraphics);
     }},
    {"AwaitedWithoutSet",
     "vkCmdWaitEvents2: an event that nothing sets is waited for without end",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       after_write(b, x);
       b.split();
       b.plan.steps.back().kind = StepKind::barriers;
       b.compute("r", {reads(x)});
     }},
    {"SetAfterWait",
     "vkCmdWaitEvents2: the set comes before it in submission order",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       after_write(b, x);
       const Index event = b.split();
       b.await(event);
       std::swap(b.plan.steps[b.plan.steps.size() - 1], b.plan.steps[b.plan.steps.size() - 2]);
       b.compute("r", {reads(x)});
     }},
    {"NeverAwaited",
     "An event that nothing awaits orders nothing",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       after_write(b, x);
       b.split();
       b.compute("r", {reads(x)});
     }},
    {"AwaitedInAnotherBatch",
     "Both halves stand in one batch, so that any number of queues can run the plan",
     {"invalid plan"},
     [](Builder& b) {
       b.queue(QueueKind::compute);
       const auto x = shared(b, "x");
       b.batch(kGraphics);
       b.compute("w", {writes(x)});
       after_write(b, x);
       const Index event = b.split();
       b.signal(kCs);
       b.batch(kGraphics);
       b.await(event);
       b.compute("r", {reads(x)});
       b.signal(kAll);
       end_on(b, kCompute);
     }},
    {"EventOnTransferQueue",
     "VUID-vkCmdSetEvent2-commandBuffer-cmdpool: graphics or compute queues",
     {"invalid plan"},
     [](Builder& b) {
       b.plan.queues = {{QueueKind::transfer}};
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.batch(0);
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.buffer_barrier(x, st::copy, ac::transfer_write, st::copy, ac::transfer_read);
       const Index event = b.split();
       b.await(event);
       b.transfer("r", {reads(x, Role::copy_src), writes(y, Role::copy_dst)});
     }},
    {"EventForTheHost",
     "VUID-vkCmdSetEvent2-srcStageMask-03827: no HOST in an event's scopes",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::readback);
       b.compute("w", {writes(x)});
       b.memory(kCs, kWrite, st::host, ac::host_read);
       const Index event = b.split();
       b.await(event);
     }},
    {"SameEventTwice",
     "An event is set once a frame",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x), writes(y)});
       after_write(b, x);
       const Index first = b.split();
       after_write(b, y);
       const Index second = b.split();
       b.plan.groups[second].event = b.plan.groups[first].event;
       b.await(first), b.await(second);
       b.compute("r", {reads(x), reads(y)});
     }},
};

class EventLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(EventLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, EventLitmus, ::testing::ValuesIn(kEventCases), litmus_name);

}  // namespace
}  // namespace rg::verify
