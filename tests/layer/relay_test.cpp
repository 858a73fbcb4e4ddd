// A frame of three queues on a real driver: right results under every order that its waits allow, and wrong ones where a wait is missing.
#include <algorithm>
#include <thread>

#include "runtime/device_state.h"
#include "runtime/handles.h"
#include "tests/layer/under_layer.h"
#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

constexpr uint32_t kFrames = 9, kWords = 64;

// Every frame copies its sums to a part of its own of one buffer of the engine's.
struct Outbox {
  UniqueMemory memory;
  UniqueBuffer buffer;
  const uint32_t* words = nullptr;
};

Outbox make_outbox(Device& device) {
  const DeviceFunctions& vk = device.vk();
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, info.size = kFrames * kWords * 4, info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  EXPECT_EQ(vk.CreateBuffer(device.handle(), &info, nullptr, &buffer), VK_SUCCESS);
  VkMemoryRequirements requirements;
  vk.GetBufferMemoryRequirements(device.handle(), buffer, &requirements);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocate.allocationSize = requirements.size;
  allocate.memoryTypeIndex =
      device.memory_type(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  EXPECT_EQ(vk.AllocateMemory(device.handle(), &allocate, nullptr, &memory), VK_SUCCESS);
  EXPECT_EQ(vk.BindBufferMemory(device.handle(), buffer, memory, 0), VK_SUCCESS);
  void* mapped = nullptr;
  EXPECT_EQ(vk.MapMemory(device.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped), VK_SUCCESS);
  return {UniqueMemory(vk, device.handle(), memory), UniqueBuffer(vk, device.handle(), buffer), static_cast<const uint32_t*>(mapped)};
}

Status execute(GraphInstance& graph, const Outbox& outbox, uint32_t frame) {
  uint32_t given[kWords];
  std::fill(std::begin(given), std::end(given), 100 * frame);
  const uint32_t step = frame + 1;
  const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))}, updates[] = {std::as_bytes(std::span(given))};
  Import result;
  result.buffer = {outbox.buffer.get(), frame * kWords * 4, kWords * 4};
  FrameInputs inputs;
  inputs.params = params, inputs.updates = updates, inputs.imports = std::span(&result, 1);
  return graph.execute(inputs);
}

// Frames in a row, nobody waits for. True: all of them are right.
bool run(Device& device, test::Relay& t, const Plan& plan, const GraphOptions& options) {
  const Outbox outbox = make_outbox(device);
  Result<GraphInstance> graph = GraphInstance::create(device, plan, options);
  EXPECT_TRUE(graph) << graph.error().message;
  for (uint32_t frame = 0; graph && frame < kFrames; ++frame) {
    const Status done = execute(*graph, outbox, frame);
    EXPECT_TRUE(done) << done.error().message;
  }
  const auto picture = graph->readback(t.result_picture);
  EXPECT_TRUE(picture) << picture.error().message;
  bool right = test::as<float>(*picture) == std::vector<float>(kWords, 3.0f);
  for (uint32_t frame = 0; frame < kFrames; ++frame)
    right &= std::all_of(outbox.words + frame * kWords, outbox.words + (frame + 1) * kWords, [&](uint32_t sum) { return sum == 101 * frame + 1; });
  return right;
}

test::Relay make_relay() {
  test::Relay t = test::relay();
  t.plan.resources[t.result_sum].lifetime = Lifetime::imported, t.plan.resources[t.result_sum].import_slot = 0;
  return t;
}

class Relay : public test::DeviceTest {
 protected:
  std::optional<Device> open_layer(std::optional<int> seed, bool validate) {
    Result<Device> device =
        test::open_under_layer(RGC_LAYER_FOLDER, seed, validate, [this](bool, std::string_view message) { messages.emplace_back(message); });
    EXPECT_TRUE(device) << device.error().message;
    return device ? std::optional(std::move(*device)) : std::nullopt;
  }
};

TEST_F(Relay, TheLayerShowsThreeFamilies) {
  auto device = open_layer(std::nullopt, false);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->queue_count(), 3u);
}

TEST_F(Relay, IsRightAndSilentInTheOrderOfTheCalls) {
  auto device = open_layer(std::nullopt, true);
  ASSERT_TRUE(device);
  test::Relay t = make_relay();
  GraphOptions options;
  options.frames_in_flight = 1;  // the validation layer misjudges frames of several queues that overlap
  EXPECT_TRUE(run(*device, t, t.plan.view(), options));
  EXPECT_EQ(device->validation_messages(), 0u) << all_messages();
}

TEST_F(Relay, IsRightUnderEverySeed) {
  test::Relay t = make_relay();
  for (int seed = 0; seed < test::seeds_to_run(); ++seed) {
    auto device = open_layer(seed, false);
    ASSERT_TRUE(device);
    GraphOptions options;
    options.frames_in_flight = 1 + static_cast<uint32_t>(seed) % 4;
    options.threads = 1 + static_cast<uint32_t>(seed) % 3;
    ASSERT_TRUE(run(*device, t, t.plan.view(), options)) << "seed " << seed;
  }
}

ExternalDevice lent(Device& engine, std::span<std::mutex> mutexes, std::vector<ExternalQueue>& more) {
  const std::vector<DeviceQueue>& queues = engine.state().queues;
  for (size_t i = 1; i < queues.size(); ++i) more.push_back({queues[i].handle, queues[i].family, &mutexes[i]});
  ExternalDevice out;
  out.instance = engine.instance(), out.physical_device = engine.physical(), out.device = engine.handle();
  out.queue = engine.queue(), out.queue_family = engine.queue_family(), out.queue_mutex = mutexes.data(), out.more_queues = more;
  out.get_instance_proc_addr = engine.state().get_instance_proc_addr;
  return out;
}

// Two graphs on the three queues of one engine, which submits to them as well, each from a thread of its own.
TEST_F(Relay, SharesTheQueuesThatAnEngineLends) {
  test::Relay t = make_relay();
  const Plan plan = t.plan.view();
  for (int seed = 0; seed < 5; ++seed) {
    auto engine = open_layer(seed, false);
    ASSERT_TRUE(engine);
    std::mutex mutexes[3];
    std::vector<ExternalQueue> more;
    const ExternalDevice external = lent(*engine, mutexes, more);
    Result<Device> one = Device::adopt(external), other = Device::adopt(external);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->queue_count(), 3u);
    EXPECT_EQ(one->queue_families().size(), 3u);
    bool right = false;
    std::thread beside([&] { right = run(*other, t, plan, {}); });
    std::thread engines([&] {
      VkSubmitInfo2 nothing{};
      nothing.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
      for (int i = 0; i < 60; ++i) {
        const DeviceQueue& queue = engine->state().queues[static_cast<size_t>(i % 3)];
        const std::lock_guard lock(mutexes[i % 3]);
        EXPECT_EQ(engine->vk().QueueSubmit2(queue.handle, 1, &nothing, VK_NULL_HANDLE), VK_SUCCESS);
      }
    });
    EXPECT_TRUE(run(*one, t, plan, {})) << "seed " << seed;
    beside.join(), engines.join();
    EXPECT_TRUE(right) << "seed " << seed;
  }
}

TEST_F(Relay, IsRightOnOneQueue) {
  RG_OPEN_DEVICE(device, true);
  test::Relay t = make_relay();
  EXPECT_TRUE(run(device, t, t.plan.view(), {}));
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

// The wait is left out of the submit; the plan stays one that is accepted.
void expect_caught(auto&& open, test::RelayWait missing) {
  int wrong = 0;
  for (int seed = 0; seed < 20; ++seed) {
    test::Relay t = make_relay();
    Plan plan = t.plan.view();
    std::vector<Batch> batches = t.plan.batches;
    std::vector<Wait> waits;
    for (Batch& batch : batches) {
      const auto kept = std::span(t.plan.waits).subspan(batch.first_wait, batch.wait_count);
      const Index first = batch.first_wait;
      batch.first_wait = static_cast<Index>(waits.size());
      for (Index i = 0; i < kept.size(); ++i)
        if (first + i != missing) waits.push_back(kept[i]);
      batch.wait_count = static_cast<uint32_t>(waits.size()) - batch.first_wait;
    }
    plan.batches = batches, plan.waits = waits;
    auto device = open(seed);
    ASSERT_TRUE(device);
    GraphOptions options;
    options.frames_in_flight = 4;
    wrong += run(*device, t, plan, options) ? 0 : 1;
  }
  EXPECT_GT(wrong, 0) << "wait " << missing << " can be left out and nobody notices";
}

TEST_F(Relay, MissingWaitsAreCaught) {
  auto open = [this](int seed) { return open_layer(seed, false); };
  for (const test::RelayWait missing : {test::kGivenWasRead, test::kGivenIsThere, test::kResultsWereRead, test::kSumIsThere})
    expect_caught(open, missing);
}

}  // namespace
}  // namespace rg
