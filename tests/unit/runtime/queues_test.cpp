// Plans of several queues on devices with any number of them.
#include <array>

#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr uint32_t kOne[64] = {1};
const std::span<const std::byte> kParams[] = {std::as_bytes(std::span(kOne, 1))};
const std::span<const std::byte> kUpdates[] = {std::as_bytes(std::span(kOne))};

FrameInputs inputs() {
  FrameInputs in;
  in.params = kParams, in.updates = kUpdates;
  return in;
}

struct Frames {
  std::string log;
  NullCounters counters;
  std::vector<std::vector<std::string>> submits;  // by frame
  std::vector<std::string> barriers;              // of the first frame
};

Frames run(const Plan& plan, const NullOptions& queues, const GraphOptions& options = {}, const FrameInputs& in = inputs(), int frames = 3) {
  Frames out;
  NullOptions null = queues;
  null.counters = &out.counters;
  Device device = Device::null(&out.log, null);
  Result<GraphInstance> graph = GraphInstance::create(device, plan, options);
  EXPECT_TRUE(graph) << graph.error().message;
  for (int frame = 0; frame < frames && graph; ++frame) {
    const size_t before = out.log.size();
    const Status done = graph->execute(in);
    EXPECT_TRUE(done) << done.error().message;
    const std::string_view text = std::string_view(out.log).substr(before);
    out.submits.push_back(test::calls(text, "vkQueueSubmit2"));
    if (frame == 0) out.barriers = test::calls(text, "vkCmdPipelineBarrier2");
  }
  EXPECT_EQ(out.counters.unmet_waits, 0u);
  return out;
}

NullOptions queues(uint32_t compute, uint32_t transfer) {
  NullOptions options;
  options.compute_queues = compute, options.transfer_queues = transfer;
  return options;
}

using Lines = std::vector<std::string>;

TEST(Queues, EachGetsItsOwnAndABatchIsOneSubmit) {
  test::Relay t = test::relay();
  const Frames frames = run(t.plan.view(), queues(1, 1));
  // semaphore1 is the instance's own, 2 to 4 are the queues'. The first frame waits for the prologue on every queue, and for no frame before it.
  EXPECT_EQ(frames.submits[0], (Lines{"vkQueueSubmit2 queue2 wait semaphore1=1 signal semaphore4=1",
                                      "vkQueueSubmit2 queue1 wait semaphore4=1 wait semaphore1=1 signal semaphore3=1",
                                      "vkQueueSubmit2 wait semaphore3=1 wait semaphore1=1 signal semaphore2=1"}));
  EXPECT_EQ(frames.submits[2], (Lines{"vkQueueSubmit2 queue2 wait semaphore3=2 signal semaphore4=3",
                                      "vkQueueSubmit2 queue1 wait semaphore4=3 wait semaphore2=2 signal semaphore3=3",
                                      "vkQueueSubmit2 wait semaphore3=3 signal semaphore2=3"}));
}

TEST(Queues, FamiliesHandOverWhatTheyDoNotShare) {
  test::Relay t = test::relay();
  const Frames frames = run(t.plan.view(), queues(1, 1));
  ASSERT_EQ(frames.barriers.size(), 4u);
  EXPECT_NE(frames.barriers[1].find("0x800000000/0x1000->0x800000000/0x0 layout 7->6 aspects 1 mips 0+1 layers 0+1 family 1->0"), std::string::npos);
  EXPECT_NE(frames.barriers[2].find("0x100000000/0x0->0x100000000/0x800 layout 7->6 aspects 1 mips 0+1 layers 0+1 family 1->0"), std::string::npos);
  EXPECT_EQ(test::calls(frames.log, "vkCreateBuffer bytes 256 usage 0x22 shared").size(), 1u);
  for (const std::string& line : test::calls(frames.log, "vkCreateImage ")) EXPECT_EQ(line.find("shared"), std::string::npos);
}

TEST(Queues, FewerRunTheBatchesInOrder) {
  test::Relay t = test::relay();
  const Frames one = run(t.plan.view(), queues(0, 0));
  // One call with three submits: the semaphores stay, the transfer is a transition where it is acquired, what each queue does first is behind the
  // prologue.
  EXPECT_EQ(one.submits[0], (Lines{"vkQueueSubmit2 signal semaphore4=1", "vkQueueSubmit2 wait semaphore4=1 signal semaphore3=1",
                                   "vkQueueSubmit2 wait semaphore3=1 signal semaphore2=1"}));
  ASSERT_EQ(one.barriers.size(), 6u);
  for (const size_t first : {0u, 1u, 3u})
    EXPECT_TRUE(one.barriers[first].ends_with("[memory 0x10000/0x10000->0x10000/0x18000]")) << one.barriers[first];
  EXPECT_EQ(one.barriers[4].find("family"), std::string::npos);
  EXPECT_NE(one.barriers[4].find("layout 7->6"), std::string::npos);
  EXPECT_TRUE(test::calls(one.log, "vkCreateBuffer bytes 256 usage 0x22 shared").empty());

  const Frames two = run(t.plan.view(), queues(1, 0));  // transfer and compute share: the compute queue is the more specialised for both
  EXPECT_EQ(two.submits[1].size(), 3u);
  EXPECT_NE(two.submits[1][0].find("vkQueueSubmit2"), std::string::npos);
  GraphOptions options;
  options.single_queue = true;
  EXPECT_EQ(run(t.plan.view(), queues(1, 1), options).submits, one.submits);
}

TEST(Queues, OfOneKindMayBeSeveral) {
  test::Relay t = test::relay();
  t.plan.queues[2].kind = QueueKind::compute;
  const Frames frames = run(t.plan.view(), queues(2, 0));
  EXPECT_EQ(frames.submits[1][0].substr(0, 22), "vkQueueSubmit2 queue2 ");
  EXPECT_EQ(frames.submits[1][1].substr(0, 22), "vkQueueSubmit2 queue1 ");
}

TEST(Queues, FramesInFlightWaitForAllOfThem) {
  test::Relay t = test::relay();
  for (uint32_t frames_in_flight = 1; frames_in_flight <= 4; ++frames_in_flight) {
    GraphOptions options;
    options.frames_in_flight = frames_in_flight;
    const Frames frames = run(t.plan.view(), queues(1, 1), options, inputs(), 6);
    const Lines waits = test::calls(frames.log, "vkWaitSemaphores semaphore1>=1");
    ASSERT_GE(waits.size(), 6 - frames_in_flight);
    EXPECT_EQ(waits[0], "vkWaitSemaphores semaphore1>=1 semaphore2>=1 semaphore3>=1 semaphore4>=1 18446744073709551615");
  }
}

TEST(Queues, ThreadsRecordTheSame) {
  test::Relay t = test::relay();
  const Frames one = run(t.plan.view(), queues(1, 1));
  GraphOptions options;
  options.threads = 4;
  const Frames four = run(t.plan.view(), queues(1, 1), options);
  EXPECT_EQ(one.submits, four.submits);
  auto without_buffers = [](Lines lines) {
    for (std::string& line : lines) line = line.substr(line.find('['));
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  EXPECT_EQ(without_buffers(one.barriers), without_buffers(four.barriers));
}

// ---- semaphores of the engine ---------------------------------------------------------------------------------------

VkSemaphore semaphore(uintptr_t number) { return reinterpret_cast<VkSemaphore>(number); }

TEST(Queues, TheWholeFrameWaitsAndIsDone) {
  test::Relay t = test::relay();
  const SemaphoreUse wait[] = {{semaphore(100), 0}}, done[] = {{semaphore(101), 7}};
  FrameInputs in = inputs();
  in.waits = wait, in.signals = done;
  const Frames three = run(t.plan.view(), queues(1, 1), {}, in, 1);
  ASSERT_EQ(three.submits[0].size(), 5u);
  EXPECT_EQ(three.submits[0].front(), "vkQueueSubmit2 wait semaphore100=0 signal semaphore1=2");
  EXPECT_NE(three.submits[0][1].find("wait semaphore1=2"), std::string::npos);
  EXPECT_EQ(three.submits[0].back(), "vkQueueSubmit2 wait semaphore2=1 wait semaphore3=1 wait semaphore4=1 signal semaphore101=7");
  const Frames one = run(t.plan.view(), queues(0, 0), {}, in, 1);
  EXPECT_EQ(one.submits[0], (Lines{"vkQueueSubmit2 wait semaphore100=0 signal semaphore4=1", "vkQueueSubmit2 wait semaphore4=1 signal semaphore3=1",
                                   "vkQueueSubmit2 wait semaphore3=1 signal semaphore2=1 signal semaphore101=7"}));
}

TEST(Queues, ASemaphoreGuardsAnImport) {
  test::Relay t = test::relay();
  t.plan.resources[t.sum].lifetime = Lifetime::imported, t.plan.resources[t.sum].import_slot = 0;
  Import import;
  import.buffer.buffer = reinterpret_cast<VkBuffer>(uintptr_t{77});
  const SemaphoreUse wait[] = {{semaphore(100), 5, stage::compute_shader, 0}, {semaphore(101), 0, stage::compute_shader, 0}};
  const SemaphoreUse done[] = {{semaphore(102), 0, stage::all_commands, 0}};
  FrameInputs in = inputs();
  in.imports = std::span(&import, 1), in.waits = wait, in.signals = done;
  const Frames frames = run(t.plan.view(), queues(1, 1), {}, in, 1);
  ASSERT_EQ(frames.submits[0].size(), 4u);  // two queues use it, so its last user is known only at the end
  EXPECT_EQ(frames.submits[0][0].find("semaphore100"), std::string::npos);
  EXPECT_NE(frames.submits[0][1].find("wait semaphore100=5 wait semaphore101=0"), std::string::npos);
  EXPECT_NE(frames.submits[0][2].find("wait semaphore100=5 signal"), std::string::npos);
  EXPECT_NE(frames.submits[0][3].find("signal semaphore102=0"), std::string::npos);
}

TEST(Queues, SemaphoresAreChecked) {
  test::Relay t = test::relay();
  Device device = Device::null(nullptr);
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph);
  FrameInputs in = inputs();
  const std::array<SemaphoreUse, 17> many{};
  in.waits = many;
  EXPECT_EQ(test::message(graph->execute(in)), "a frame waits for 17 semaphores; at most 16");
  in.waits = std::span(many).first(1);
  EXPECT_EQ(test::message(graph->execute(in)), "the frame waits for no semaphore");
  const SemaphoreUse wrong[] = {{semaphore(1), 1, stage::copy, 3}};
  in.waits = {}, in.signals = wrong;
  EXPECT_EQ(test::message(graph->execute(in)), "a semaphore guards import slot 3 of 0");
}

// ---- broken tables --------------------------------------------------------------------------------------------------

template <class Break>
std::string fault(Break&& break_plan) {
  test::Relay t = test::relay();
  break_plan(t.plan, t);
  Device device = Device::null(nullptr);
  const Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  return graph ? "no error" : graph.error().message;
}

TEST(Queues, BrokenTablesAreRefused) {
  using P = test::TestPlan;
  using R = test::Relay;
  EXPECT_EQ(fault([](P&, R&) {}), "no error");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kGivenIsThere].value = 2; }), "plan `test`: wait 1: for a value that its queue does not signal");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kGivenIsThere].value = 0; }), "plan `test`: wait 1: for a value that its queue does not signal");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kResultsWereRead].frames_ago = 0; }), "plan `test`: wait 2: for a batch that is listed later");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kSumIsThere].frames_ago = 2; }), "plan `test`: wait 3: frames ago");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kSumIsThere].queue = 3; }), "plan `test`: wait 3: queue");
  EXPECT_EQ(fault([](P& p, R&) { p.waits[test::kSumIsThere].stages = 0; }), "plan `test`: wait 3: no stages");
  EXPECT_EQ(fault([](P& p, R&) { p.signals[1].value = 2; }), "plan `test`: signal 1: values of a queue count 1, 2, ... in the order of its batches");
  EXPECT_EQ(fault([](P& p, R&) { p.batches[2].signal_count = 0; }), "plan `test`: wait 2: for a value that its queue does not signal");
  EXPECT_EQ(fault([](P& p, R&) { p.batches[2].signal_count = 0, p.waits[2].queue = 1; }),
            "plan `test`: batch 2: the last of its queue signals nothing");
  EXPECT_EQ(fault([](P& p, R&) { p.batches[1].step_count += 1; }), "plan `test`: batch 2: a step of another batch");
  EXPECT_EQ(fault([](P& p, R&) { p.batches[2].step_count -= 1; }), "plan `test`: step 7: in no batch");
  EXPECT_EQ(fault([](P& p, R&) { p.steps[4] = p.steps[2]; }), "plan `test`: step 4: recorded twice");
  EXPECT_EQ(fault([](P& p, R&) { p.queues[1].kind = QueueKind::transfer; }), "plan `test`: pass 1: work that its queue cannot do");
  EXPECT_EQ(fault([](P& p, R&) { p.passes[1].queue = 0; }), "plan `test`: pass 1: on another queue than its batch");
  EXPECT_EQ(fault([](P& p, R&) { p.image_barriers[0].src_stages |= stage::fragment_shader; }),
            "plan `test`: image barrier 0: stages that its queue does not have");
  EXPECT_EQ(fault([](P& p, R&) { p.image_barriers[1].src_queue = 1, p.image_barriers[1].dst_queue = 9; }),
            "plan `test`: image barrier 1: queues of the transfer");
  EXPECT_EQ(fault([](P& p, R&) { p.image_barriers[2].new_layout = Layout::general; }),
            "plan `test`: batch 2: acquires what no batch before it released");
  EXPECT_EQ(fault([](P& p, R&) { p.image_barriers[2].src_queue = p.image_barriers[2].dst_queue = kNone; }),
            "plan `test`: batch 1: releases what no batch after it acquires");
  EXPECT_EQ(fault([](P& p, R& t) { p.resources[t.picture].concurrent = true; }), "plan `test`: batch 1: transfers a resource that all queues share");
  EXPECT_EQ(fault([](P& p, R&) { p.queues.resize(17); }), "plan `test`: plan 0: more than 16 queues");
}

}  // namespace
}  // namespace rg
