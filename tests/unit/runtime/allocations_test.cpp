// A frame allocates nothing: counted by replacing operator new, and where nobody else does malloc, for this executable.
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace {
std::atomic<bool> counting = false;
std::atomic<uint64_t> allocations = 0;
void count() {
  if (counting.load(std::memory_order_relaxed)) allocations.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RG_COUNTS_MALLOC 1
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#undef RG_COUNTS_MALLOC
#endif
#endif
#endif

#ifdef RG_COUNTS_MALLOC
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* malloc(size_t bytes) noexcept {
  count();
  return __libc_malloc(bytes);
}
void* calloc(size_t rows, size_t bytes) noexcept {
  count();
  return __libc_calloc(rows, bytes);
}
void* realloc(void* memory, size_t bytes) noexcept {
  count();
  return __libc_realloc(memory, bytes);
}
}
#else  // sanitizers have a malloc of their own
namespace {
void* allocate(std::size_t bytes) {
  count();
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace rg {
namespace {

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

constexpr uint32_t kData[64] = {};
const std::span<const std::byte> kUpdates[] = {std::as_bytes(std::span(kData))};

uint64_t allocations_of_frames(test::TestPlan& plan, int frames, const GraphOptions& options = {}, bool semaphores = false) {
  std::string log;
  log.reserve(1 << 20);
  NullOptions queues;
  queues.compute_queues = queues.transfer_queues = 1;
  Device device = Device::null(&log, queues);
  Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
  EXPECT_TRUE(graph);
  const uint32_t step = 1;
  const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))};
  FrameInputs inputs;
  inputs.params = params, inputs.callbacks = kIgnore, inputs.updates = kUpdates;
  const SemaphoreUse waits[] = {{reinterpret_cast<VkSemaphore>(uintptr_t{900})}}, signals[] = {{reinterpret_cast<VkSemaphore>(uintptr_t{901})}};
  const auto execute = [&] {
    if (semaphores) {
      EXPECT_TRUE(graph->use_semaphores(waits, signals));
    }
    EXPECT_TRUE(graph->execute(inputs));
  };
  for (int frame = 0; frame < 5; ++frame) execute();  // each frame in flight once
  allocations = 0, counting = true;
  for (int frame = 0; frame < frames; ++frame) execute();
  counting = false;
  EXPECT_EQ(graph->frame(), static_cast<uint64_t>(frames) + 5);
  return allocations;
}

TEST(Allocations, AreCounted) {
  counting = true;
  allocations = 0;
  delete new int(1);
  counting = false;
  EXPECT_EQ(allocations, 1u);
#ifdef RG_COUNTS_MALLOC
  counting = true;
  void* volatile memory = std::malloc(1);
  counting = false;
  std::free(memory);
  EXPECT_EQ(allocations, 2u);
#endif
}

TEST(Allocations, NoneInAFrame) {
  test::Counter counter = test::counter();
  EXPECT_EQ(allocations_of_frames(counter.plan, 20), 0u);
  test::Tint tint = test::tint();
  EXPECT_EQ(allocations_of_frames(tint.plan, 20), 0u);
  test::Mips mips = test::mips();
  EXPECT_EQ(allocations_of_frames(mips.plan, 20), 0u);
  test::Aliased aliased = test::aliased();
  EXPECT_EQ(allocations_of_frames(aliased.plan, 20), 0u);
  test::Relay relay = test::relay();
  EXPECT_EQ(allocations_of_frames(relay.plan, 20), 0u);
}

TEST(Allocations, NoneWithThreadsSemaphoresOrTools) {
  GraphOptions threads, single, serial, statistics, one_by_one;
  threads.threads = 3, single.single_queue = true, serial.serial = serial.poison = true, statistics.statistics = true,
  one_by_one.submit_per_pass = true;
  test::Counter counter = test::counter();
  test::Relay relay = test::relay();
  test::Tint tint = test::tint();
  for (const GraphOptions& options : {threads, single, serial, statistics, one_by_one})
    for (test::TestPlan* plan : {&counter.plan, &relay.plan, &tint.plan}) {
      EXPECT_EQ(allocations_of_frames(*plan, 20, options), 0u);
      EXPECT_EQ(options.submit_per_pass ? 0 : allocations_of_frames(*plan, 20, options, true), 0u) << "with semaphores";
    }
}

}  // namespace
}  // namespace rg
