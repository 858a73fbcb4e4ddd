// The file that keeps pipelines: taken whole from the same device and driver or not at all, replaced in one step, and every failure a value.
#include "runtime/pipeline_cache.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "runtime/device_state.h"
#include "runtime/plan_fields.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

namespace fs = std::filesystem;

constexpr size_t kOwnHeader = 32, kDriverHeader = 32, kNullData = kDriverHeader + 8;

std::string little(uint64_t value, size_t bytes) {
  std::string text;
  for (size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
  return text;
}

// A file as the format says, around any data.
std::string file_around(const std::string& data) {
  return "rgcpipe\n" + little(1, 4) + little(3, 4) + little(data.size(), 8) + little(plan_file::checksum(data), 8) + data;
}

std::string driver_header(uint32_t bytes, uint32_t version, uint32_t vendor, uint32_t device, const std::string& uuid) {
  return little(bytes, 4) + little(version, 4) + little(vendor, 4) + little(device, 4) + uuid;
}
const std::string kUuid = "null" + std::string(12, '\0');

class PipelineCache : public testing::Test {
 protected:
  PipelineCache() { fs::create_directories(folder); }
  ~PipelineCache() override { fs::remove_all(folder); }

  std::string read() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  size_t files() const { return static_cast<size_t>(std::distance(fs::directory_iterator(folder), {})); }
  ino_t inode() const {
    struct stat about {};
    EXPECT_EQ(::stat(path.c_str(), &about), 0);
    return about.st_ino;
  }

  // The bytes that a device of its own takes from the file as it is.
  uint64_t loaded(const CacheIdentity* identity = nullptr) {
    std::string log;
    Device device = Device::null(&log, {.counters = &counters});
    if (identity != nullptr) device.state().identity = *identity;
    const Status opened = open_pipeline_cache(device.state(), path);
    EXPECT_TRUE(opened) << test::message(opened);
    EXPECT_EQ(log, "vkCreatePipelineCache bytes " + std::to_string(device.pipeline_cache_loaded()) + " -> cache1\n");
    device.state().lost = true;  // leaves the file alone
    return device.pipeline_cache_loaded();
  }
  // A run of a program: opens the file, makes the pipelines of a frame, and ends.
  void run() {
    Device device = Device::null(nullptr, {.counters = &counters});
    ASSERT_TRUE(open_pipeline_cache(device.state(), path));
    ASSERT_TRUE(GraphInstance::create(device, counter.plan.view(), {}));
  }

  fs::path folder = fs::path(testing::TempDir()) / ("pipeline_cache_" + std::to_string(::getpid()));
  std::string path = (folder / "a.pipelines").string();
  NullCounters counters;
  test::Counter counter = test::counter();
};

TEST_F(PipelineCache, IsWrittenAtTheEndAndTakenAtTheNextStart) {
  EXPECT_EQ(loaded(), 0u);
  EXPECT_EQ(files(), 0u);
  run();
  EXPECT_EQ(files(), 1u);
  const std::string file = read();
  ASSERT_EQ(file.size(), kOwnHeader + kNullData);
  EXPECT_EQ(file, file_around(file.substr(kOwnHeader)));
  EXPECT_EQ(file.substr(kOwnHeader, kDriverHeader), driver_header(32, 1, 1, 2, kUuid));
  EXPECT_EQ(loaded(), kNullData);
  EXPECT_EQ(counters.live_handles, 0u);
  EXPECT_EQ(counters.wrong_destroys, 0u);
}

TEST_F(PipelineCache, IsWrittenAgainOnlyWhereItChangedOrIsAsked) {
  run();
  const ino_t first = inode();
  run();  // the same pipelines
  EXPECT_EQ(inode(), first);
  Device device = Device::null(nullptr);
  ASSERT_TRUE(open_pipeline_cache(device.state(), path));
  const std::string before = read();
  ASSERT_TRUE(device.save_pipeline_cache());  // none were made
  EXPECT_NE(inode(), first);
  EXPECT_NE(read(), before);
  const ino_t saved = inode();
  ASSERT_TRUE(device.save_pipeline_cache());
  EXPECT_NE(inode(), saved);
}

TEST_F(PipelineCache, DamagedAnywhereCountsAsEmpty) {
  run();
  const std::string good = read();
  for (size_t at = 0; at < good.size(); ++at)
    for (const int bit : {0, 7}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ 1 << bit);
      write(bad);
      EXPECT_EQ(loaded(), 0u) << "byte " << at;
    }
  for (size_t bytes = 0; bytes < good.size(); ++bytes) {
    write(good.substr(0, bytes));
    EXPECT_EQ(loaded(), 0u) << bytes << " bytes of it";
  }
  write(good + "x");
  EXPECT_EQ(loaded(), 0u);
  write(good + good);
  EXPECT_EQ(loaded(), 0u);
  write(good);
  EXPECT_EQ(loaded(), kNullData);
}

TEST_F(PipelineCache, OfAnotherDeviceOrDriverCountsAsEmpty) {
  run();
  Device device = Device::null(nullptr);
  const CacheIdentity own = device.state().identity;
  EXPECT_EQ(loaded(&own), kNullData);
  CacheIdentity other = own;
  ++other.vendor;
  EXPECT_EQ(loaded(&other), 0u);
  other = own, ++other.device;
  EXPECT_EQ(loaded(&other), 0u);
  other = own, ++other.driver;
  EXPECT_EQ(loaded(&other), 0u);
  other = own, ++other.uuid[15];
  EXPECT_EQ(loaded(&other), 0u);
}

TEST_F(PipelineCache, ThatTheDriverWouldMisreadCountsAsEmpty) {
  const auto with = [&](const std::string& data) {
    write(file_around(data));
    return loaded();
  };
  const std::string rest = "compiled code";
  EXPECT_EQ(with(driver_header(32, 1, 1, 2, kUuid)), kDriverHeader);
  EXPECT_EQ(with(driver_header(32, 1, 1, 2, kUuid) + rest), kDriverHeader + rest.size());
  EXPECT_EQ(with(driver_header(40, 1, 1, 2, kUuid) + rest), kDriverHeader + rest.size()) << "a longer header of a later version";
  EXPECT_EQ(with(driver_header(31, 1, 1, 2, kUuid) + rest), 0u);
  EXPECT_EQ(with(driver_header(100, 1, 1, 2, kUuid) + rest), 0u);
  EXPECT_EQ(with(driver_header(32, 2, 1, 2, kUuid) + rest), 0u);
  EXPECT_EQ(with(driver_header(32, 1, 9, 2, kUuid) + rest), 0u);
  EXPECT_EQ(with(driver_header(32, 1, 1, 9, kUuid) + rest), 0u);
  EXPECT_EQ(with(driver_header(32, 1, 1, 2, "other" + std::string(11, '\0')) + rest), 0u);
  EXPECT_EQ(with(driver_header(32, 1, 1, 2, kUuid).substr(0, 31)), 0u);
  EXPECT_EQ(with(""), 0u);
}

TEST_F(PipelineCache, OfAnythingButAFileCountsAsEmpty) {
  fs::create_directory(path);
  EXPECT_EQ(loaded(), 0u);
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);  // reading it would wait for ever
  EXPECT_EQ(loaded(), 0u);
  fs::remove(path);
  write("");
  fs::resize_file(path, (uintmax_t{256} << 20) + kOwnHeader + 1);
  EXPECT_EQ(loaded(), 0u);
}

TEST_F(PipelineCache, IsWhatPipelinesAreMadeWith) {
  static VkPipelineCache seen = VK_NULL_HANDLE;
  static PFN_vkCreateComputePipelines create = nullptr;
  Device device = Device::null(nullptr);
  ASSERT_TRUE(open_pipeline_cache(device.state(), path));
  create = std::exchange(device.state().vk.CreateComputePipelines,
                         [](VkDevice handle, VkPipelineCache cache, uint32_t count, const VkComputePipelineCreateInfo* infos,
                            const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
                           seen = cache;
                           return create(handle, cache, count, infos, allocator, pipelines);
                         });
  ASSERT_TRUE(GraphInstance::create(device, counter.plan.view(), {}));
  EXPECT_NE(seen, VkPipelineCache(VK_NULL_HANDLE));
  EXPECT_EQ(seen, device.state().cache_file.cache.get());
}

// Every call of a run, one at a time. The file is the old one or a good one, and nothing else lies in the folder.
TEST_F(PipelineCache, FailuresOfEveryCallAreReportedAndLeaveAGoodFile) {
  run();
  const std::string good = read();
  const auto attempt = [&](uint64_t fail_at) {
    counters = {};
    write(good);
    std::string log;
    bool noticed = false;
    {
      Device device = Device::null(&log, {.fail_at = fail_at, .counters = &counters});
      const Status opened = open_pipeline_cache(device.state(), path);
      noticed = !opened || device.pipeline_cache_loaded() == 0;
      if (opened) {
        noticed |= !GraphInstance::create(device, counter.plan.view(), {});
        const Status saved = device.save_pipeline_cache();
        noticed |= !saved;
        EXPECT_TRUE(saved || device.save_pipeline_cache()) << "tried again";
      }
    }
    const bool unnamed = log.find("vkSetDebugUtilsObjectNameEXT") != std::string::npos;
    EXPECT_TRUE(noticed || fail_at == 0 || unnamed || fail_at > counters.fallible_calls) << "call " << fail_at;
    EXPECT_EQ(counters.live_handles, 0u) << "call " << fail_at;
    EXPECT_EQ(counters.wrong_destroys, 0u) << "call " << fail_at;
    EXPECT_EQ(files(), 1u) << "call " << fail_at;
    const uint64_t calls = counters.fallible_calls;
    EXPECT_EQ(loaded(), kNullData) << "call " << fail_at;
    return calls;
  };
  const uint64_t calls = attempt(0);
  ASSERT_GT(calls, 20u);
  for (uint64_t fail_at = 1; fail_at <= calls; ++fail_at) attempt(fail_at);
}

TEST_F(PipelineCache, ThatTheDriverDoesNotTakeIsAnEmptyOne) {
  run();
  std::string log;
  Device device = Device::null(&log, {.fail_at = 1});
  ASSERT_TRUE(open_pipeline_cache(device.state(), path));
  EXPECT_EQ(log, "vkCreatePipelineCache bytes 40 -> failed\nvkCreatePipelineCache bytes 0 -> cache1\n");
  EXPECT_EQ(device.pipeline_cache_loaded(), 0u);
  Device none = Device::null(nullptr, {.fail_at = 1, .fails_from_then_on = true});
  const Status opened = open_pipeline_cache(none.state(), path);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::out_of_memory);
  EXPECT_EQ(opened.error().message, "`" + path + "`: vkCreatePipelineCache failed with VK_ERROR_OUT_OF_DEVICE_MEMORY");
}

TEST_F(PipelineCache, ThatGrowsWhileItIsTakenIsAPart) {
  static PFN_vkGetPipelineCacheData get = nullptr;
  {
    Device device = Device::null(nullptr);
    ASSERT_TRUE(open_pipeline_cache(device.state(), path));
    get = std::exchange(device.state().vk.GetPipelineCacheData, [](VkDevice handle, VkPipelineCache cache, size_t* size, void* data) {
      const VkResult result = get(handle, cache, size, data);
      if (data == nullptr) *size = kDriverHeader + 3;  // as much as there was a moment ago
      return result;
    });
    ASSERT_TRUE(device.save_pipeline_cache());
  }
  EXPECT_EQ(loaded(), kDriverHeader);
}

TEST_F(PipelineCache, ThatCannotBeWrittenIsAnError) {
  const auto save = [](const std::string& to) {
    Device device = Device::null(nullptr);
    EXPECT_TRUE(open_pipeline_cache(device.state(), to));
    return test::message(device.save_pipeline_cache());
  };
  const std::string lost = (folder / "gone" / "a").string();
  EXPECT_EQ(save(lost), "`" + lost + "` cannot be written: No such file or directory");
  fs::create_directory(path);
  EXPECT_EQ(save(path), "`" + path + "` cannot be written: Is a directory");
  EXPECT_EQ(files(), 1u) << "nothing beside it";
  fs::remove(path);

  run();
  const std::string good = read();
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit little{16, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const std::string full = save(path);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(full, "`" + path + "` cannot be written: File too large");
  EXPECT_EQ(read(), good);
  EXPECT_EQ(files(), 1u);
}

TEST_F(PipelineCache, OfADeviceWithoutAFileOrThatIsLostIsNotSaved) {
  Device plain = Device::null(nullptr);
  EXPECT_EQ(test::message(plain.save_pipeline_cache()), "this device has no file for pipelines; name one as DeviceOptions::pipeline_cache");
  EXPECT_EQ(plain.save_pipeline_cache().error().code, ErrorCode::invalid_argument);
  {
    Device device = Device::null(nullptr, {.counters = &counters});
    ASSERT_TRUE(open_pipeline_cache(device.state(), path));
    device.state().lost = true;
    const uint64_t calls = counters.fallible_calls;
    EXPECT_EQ(device.save_pipeline_cache().error().code, ErrorCode::device_lost);
    EXPECT_EQ(counters.fallible_calls, calls);
  }
  EXPECT_EQ(files(), 0u);
  EXPECT_EQ(counters.live_handles, 0u);
}

TEST_F(PipelineCache, IsWholeWhoeverSavesIt) {
  Device one = Device::null(nullptr), other = Device::null(nullptr);
  for (Device* device : {&one, &other}) ASSERT_TRUE(open_pipeline_cache(device->state(), path));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) EXPECT_TRUE((i % 2 == 0 ? one : other).save_pipeline_cache());
    });
  for (int round = 0; round < 20; ++round) {
    EXPECT_TRUE(GraphInstance::create(one, counter.plan.view(), {}));
    if (fs::exists(path)) {
      EXPECT_EQ(loaded(), kNullData);
    }
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(loaded(), kNullData);
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace rg
