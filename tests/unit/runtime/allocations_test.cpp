// A frame allocates nothing: counted by replacing operator new for this executable.
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace {
std::atomic<bool> counting = false;
std::atomic<uint64_t> allocations = 0;

void* allocate(std::size_t bytes) {
  if (counting) ++allocations;
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

namespace rg {
namespace {

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

uint64_t allocations_of_frames(test::TestPlan& plan, int frames) {
  std::string log;
  log.reserve(1 << 20);
  Device device = Device::null(&log);
  Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), {});
  EXPECT_TRUE(graph);
  const uint32_t step = 1;
  const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))};
  FrameInputs inputs;
  inputs.params = params, inputs.callbacks = kIgnore;
  EXPECT_TRUE(graph->execute(inputs));
  allocations = 0, counting = true;
  for (int frame = 0; frame < frames; ++frame) static_cast<void>(graph->execute(inputs));
  counting = false;
  EXPECT_EQ(graph->frame(), static_cast<uint64_t>(frames) + 1);
  return allocations;
}

TEST(Allocations, AreCounted) {
  counting = true;
  allocations = 0;
  delete new int(1);
  counting = false;
  EXPECT_EQ(allocations, 1u);
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
}

}  // namespace
}  // namespace rg
