// The file that keeps pipelines, with what a real driver makes of it.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

namespace fs = std::filesystem;

class PipelineCacheOnDevice : public test::DeviceTest {
 protected:
  PipelineCacheOnDevice() { fs::create_directories(folder); }
  ~PipelineCacheOnDevice() override { fs::remove_all(folder); }

  // A run of a program; `loaded`: bytes of the file that it took.
  void run(uint64_t& loaded) {
    DeviceOptions options;
    options.pipeline_cache = path;
    std::optional<Device> device = open(true, options);
    if (!device) return;
    loaded = device->pipeline_cache_loaded();
    test::Counter counter = test::counter();
    Result<GraphInstance> graph = GraphInstance::create(*device, counter.plan.view(), {});
    ASSERT_TRUE(graph) << graph.error().message;
    constexpr uint32_t step = 1;
    constexpr uint32_t data[64] = {};
    const std::span<const std::byte> params[] = {std::as_bytes(std::span(&step, 1))}, updates[] = {std::as_bytes(std::span(data))};
    FrameInputs inputs;
    inputs.params = params, inputs.updates = updates;
    RG_ASSERT_OK(graph->execute(inputs));
    RG_ASSERT_OK(graph->wait_idle());
    EXPECT_EQ(all_messages(), "");
  }

  fs::path folder = fs::path(testing::TempDir()) / ("pipelines_on_device_" + std::to_string(::getpid()));
  std::string path = (folder / "a.pipelines").string();
};

TEST_F(PipelineCacheOnDevice, IsTakenByTheNextRunUnlessItIsDamaged) {
  uint64_t first = 1, second = 0, damaged = 1;
  run(first);
  if (HasFailure()) return;
  if (!reason.empty()) GTEST_SKIP() << reason;
  EXPECT_EQ(first, 0u);
  ASSERT_TRUE(fs::exists(path));
  run(second);
  EXPECT_GE(second, 32u) << "a header at least";
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(-1, std::ios::end);
  file.put('!');
  file.close();
  run(damaged);
  EXPECT_EQ(damaged, 0u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace rg
