// Random operations on a real driver, validated: resizes, other plans, reloads, other threads and frames in flight, turns, invalidations. 300 by
// default, 10,000 with RGC_LONG.
#include <cstdio>
#include <fstream>
#include <map>
#include <random>

#include "compiler/codegen/plan_file.h"
#include "runtime/device_state.h"
#include "runtime/plan_file.h"
#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Soak = test::DeviceTest;

// Resident memory tells nothing under a sanitizer, which remembers what was freed.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool kResidentIsOurs = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kResidentIsOurs = false;
#else
constexpr bool kResidentIsOurs = true;
#endif
#else
constexpr bool kResidentIsOurs = true;
#endif

uint64_t resident_kib() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word)
    if (word == "VmRSS:") {
      uint64_t kib = 0;
      file >> kib;
      return kib;
    }
  return 0;
}

constexpr uint32_t kMostWords = 256;

// Two variants of a plan with one history: `state` counts up by `step`; the second counts with a further copy, as a feature might.
struct Variants {
  test::Counter plain = test::counter(), copying = test::counter();
  Variants() {
    Transfer again;
    again.kind = TransferKind::copy_buffer, again.src = {copying.state, 0}, again.dst = {copying.result, 0};
    TestPlan& p = copying.plan;
    p.barriers({},
               {test::buffer_barrier({copying.result, 0}, stage::copy | stage::host, access::transfer_write, stage::copy, access::transfer_write)});
    p.transfer("again", {again},
               {test::touches({copying.state, 0}, stage::copy, access::transfer_read, Layout::undefined, false),
                test::touches({copying.result, 0}, stage::copy, access::transfer_write, Layout::undefined, true)});
    p.barriers({}, {test::to_host(copying.result)});
    for (TestPlan* plan : {&plain.plan, &copying.plan}) size_by_extent(*plan);
  }
  using TestPlan = test::TestPlan;

 private:
  // As many words as "words" says, of which the shader counts up the first 64.
  static void size_by_extent(TestPlan& p) {
    p.extents.push_back({"words", 1, {64, 1, 1}, {kMostWords, 1, 1}});
    const Index bytes = p.binary(ExprOp::mul, p.extent_axis(0), p.constant(4));
    for (Resource& resource : p.resources) resource.bytes = bytes;
  }
};

class Walk {
 public:
  Walk(Device& device, uint32_t seed) : random_(seed), plans_{variants_.plain.plan.view(), variants_.copying.plan.view()} {
    for (int i = 0; i < 2; ++i) files_[i] = compiler::emit_plan_file({&plans_[i], 1});
    options_.heap = make_transient_heap();
    current_.emplace(take(GraphInstance::create(device, plans_[0], options_)));
  }

  void operate() {
    switch (random_() % 9) {
      case 0:
        return resize();
      case 1:
      case 2:
        return succeed();
      case 3:
        return go_back();
      case 4:
        return invalidate();
      case 5:
        return reload();
      default:
        return frames(1 + random_() % 3);
    }
  }
  void check() {
    const auto words = current_->readback(variants_.plain.result);
    ASSERT_TRUE(words) << words.error().message;
    std::vector<uint32_t> right(words_, 7);
    std::fill_n(right.begin(), 64, expected_);
    ASSERT_EQ(test::as<uint32_t>(*words), right);
  }
  void finish() {
    frames(2);
    check();
  }

 private:
  static GraphInstance take(Result<GraphInstance> graph) {
    EXPECT_TRUE(graph) << graph.error().message;
    return std::move(*graph);
  }
  void frames(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t step = static_cast<uint32_t>(random_() % 100);
      const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))};
      FrameInputs inputs;
      inputs.params = params;
      const Status done = current_->execute(inputs);
      ASSERT_TRUE(done) << done.error().message;
      expected_ += step;
    }
  }
  void resize() {
    words_ = 64 + static_cast<uint32_t>(random_() % 4) * (kMostWords - 64) / 3;
    const int64_t extents[] = {words_, 1, 1};
    const Status done = current_->resize(extents);
    ASSERT_TRUE(done) << done.error().message;
    before_.reset(), before_file_.reset();  // its history is another's now
    expected_ = 7;
  }
  void invalidate() {
    const Status done = current_->invalidate(variants_.plain.state);
    ASSERT_TRUE(done) << done.error().message;
    expected_ = 7;
    frames(1);  // another instance may go on before this one does
  }
  // Another variant, another number of threads and of frames in flight; the one before is kept for a while.
  void succeed() { follow(plans_[random_() % 2], std::nullopt); }
  // From the bytes of a file, which are damaged now and then: refused, and nothing has happened.
  void reload() {
    std::string bytes = files_[random_() % 2];
    if (random_() % 4 == 0) bytes[random_() % bytes.size()] ^= 4;
    const bool good = bytes == files_[0] || bytes == files_[1];
    const Result<PlanFile> file = PlanFile::parse(std::as_bytes(std::span(bytes)), "soak");
    ASSERT_EQ(static_cast<bool>(file), good);
    if (file) follow(file->plans()[0], *file);
  }
  void follow(const Plan& plan, const std::optional<PlanFile>& file) {
    options_.threads = 1 + static_cast<uint32_t>(random_() % 3);
    options_.frames_in_flight = 1 + static_cast<uint32_t>(random_() % 4);
    options_.serial = random_() % 5 == 0;
    GraphInstance next = take(GraphInstance::create_successor(*current_, plan, options_));
    before_.emplace(std::move(*current_));
    current_.emplace(std::move(next));
    before_file_ = std::exchange(current_file_, file);
  }
  void go_back() {
    if (!before_) return;
    const Status followed = before_->continue_from(*current_);
    ASSERT_TRUE(followed) << followed.error().message;
    std::swap(*before_, *current_);
    std::swap(before_file_, current_file_);
  }

  std::mt19937 random_;
  Variants variants_;
  Plan plans_[2];
  std::string files_[2];
  GraphOptions options_;
  std::optional<PlanFile> current_file_, before_file_;  // of the plans of these two
  std::optional<GraphInstance> current_, before_;
  uint32_t expected_ = 7, words_ = 64;
};

int operations() {
  const char* text = std::getenv("RGC_LONG");
  return text != nullptr && *text == '1' ? 10000 : 300;
}

// Bytes of device memory that are allocated now, through the device's function table.
class DeviceMemory {
 public:
  explicit DeviceMemory(Device& device) {
    DeviceFunctions& vk = device.state().vk;
    allocate = vk.AllocateMemory, release = vk.FreeMemory;
    sizes.clear();
    vk.AllocateMemory = [](VkDevice on, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
      const VkResult result = allocate(on, info, allocator, memory);
      if (result == VK_SUCCESS) sizes[*memory] = info->allocationSize;
      return result;
    };
    vk.FreeMemory = [](VkDevice on, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
      sizes.erase(memory);
      release(on, memory, allocator);
    };
  }
  static uint64_t bytes() {
    uint64_t sum = 0;
    for (const auto& [memory, size] : sizes) sum += size;
    return sum;
  }

 private:
  static inline PFN_vkAllocateMemory allocate = nullptr;
  static inline PFN_vkFreeMemory release = nullptr;
  static inline std::map<VkDeviceMemory, VkDeviceSize> sizes;
};

struct Figures {
  uint64_t first_kib = 0, early_kib = 0, late_kib = 0;                            // resident
  uint64_t device_first = 0, device_early = 0, device_most = 0, device_last = 0;  // bytes; early: most until a third
};

// Operates, and looks at memory after a third and at the end; the picture is right at the end.
void soak(Device& device, Figures& out) {
  const DeviceMemory memory(device);
  const int count = operations();
  {
    Walk run(device, 1);
    out.first_kib = resident_kib(), out.device_first = DeviceMemory::bytes();
    for (int i = 0; i < count; ++i) {
      ASSERT_NO_FATAL_FAILURE(run.operate()) << "operation " << i;
      if (i == count / 3) out.early_kib = resident_kib(), out.device_early = out.device_most;
      out.device_most = std::max(out.device_most, DeviceMemory::bytes());
    }
    ASSERT_NO_FATAL_FAILURE(run.finish());
    out.late_kib = resident_kib(), out.device_last = DeviceMemory::bytes();
  }
  EXPECT_EQ(DeviceMemory::bytes(), 0u);
}

void record(const Figures& figures) {
  testing::Test::RecordProperty("rss_kib_after_a_third", static_cast<int>(figures.early_kib));
  testing::Test::RecordProperty("rss_kib_at_the_end", static_cast<int>(figures.late_kib));
  testing::Test::RecordProperty("device_bytes_at_most", static_cast<int>(figures.device_most));
  const auto number = [](uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "%d operations: RSS %llu KiB at the start, %llu KiB after a third, %llu KiB at the end; device memory %llu bytes at the start, %llu at most, "
      "%llu at the end\n",
      operations(), number(figures.first_kib), number(figures.early_kib), number(figures.late_kib), number(figures.device_first),
      number(figures.device_most), number(figures.device_last));
}

TEST_F(Soak, RandomOperationsLeaveMemoryFlat) {
  RG_OPEN_DEVICE(device, false);
  Figures figures;
  ASSERT_NO_FATAL_FAILURE(soak(device, figures));
  record(figures);
  if (kResidentIsOurs) {
    EXPECT_LT(figures.late_kib, figures.early_kib + 4 * 1024);
  }
  EXPECT_LE(figures.device_most, 2 * figures.device_early);
}

// Of every object that was ever made the validation layer of Debian 12 keeps something: about 1.2 KiB an operation here, none of it allocated by us
// (heaptrack), and a loop of vkAllocateCommandBuffers and vkFreeCommandBuffers alone makes it grow by 3.2 KiB a round. Pools are therefore used again
// while it watches.
TEST_F(Soak, RandomOperationsAreSilentAndLeaveNothing) {
  RG_OPEN_DEVICE(device, true);
  Figures figures;
  ASSERT_NO_FATAL_FAILURE(soak(device, figures));
  record(figures);
  if (kResidentIsOurs) {
    EXPECT_LT(figures.late_kib, figures.early_kib + 8 * 1024 + 3 * static_cast<uint64_t>(operations()));
  }
  EXPECT_LE(figures.device_most, 2 * figures.device_early);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

}  // namespace
}  // namespace rg
