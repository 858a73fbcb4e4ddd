// What an engine does with the runtime: its own device, its own images, several instances, several threads.
#include <dlfcn.h>

#include <algorithm>
#include <thread>

#include "runtime/device_state.h"
#include "runtime/handles.h"
#include "tests/unit/device/fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using Engine = test::DeviceTest;

void ignore(void*, Recording&) {}
constexpr RecordFunction kIgnore[] = {ignore};

void expect_magenta(GraphInstance& graph, Index result) {
  const auto bytes = graph.readback(result);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(test::as<uint32_t>(*bytes), std::vector<uint32_t>(32, 0xffff00ffu));
}

TEST_F(Engine, ListedDevicesCanBeChosenByIndex) {
  RG_OPEN_DEVICE(device, false);
  const std::vector<DeviceDescription> devices = list_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [&](const DeviceDescription& row) { return row.name == device.name(); }));
  for (size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].usable, devices[i].reason.empty());
    DeviceOptions options;
    options.device = static_cast<int>(i);
    const Result<Device> chosen = Device::create(options);
    EXPECT_EQ(static_cast<bool>(chosen), devices[i].usable);
    EXPECT_EQ(chosen ? chosen->name() : "", devices[i].usable ? devices[i].name : "");
  }
  DeviceOptions options;
  options.device = static_cast<int>(devices.size());
  const Result<Device> none = Device::create(options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(none.error().message, "there is no device " + std::to_string(devices.size()) + ": found " + std::to_string(devices.size()));
}

class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~ScopedVariable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(Engine, WithoutADriverThereIsAWayOut) {
  const ScopedVariable no_drivers("VK_DRIVER_FILES", "/nonexistent");
  const Result<Device> none = Device::create({});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::unsupported);
  EXPECT_EQ(none.error().message, "no Vulkan device; the package `mesa-vulkan-drivers` brings one that runs on the CPU");
  EXPECT_TRUE(list_devices().empty());
}

TEST_F(Engine, WithoutTheLayerValidationIsAnError) {
  const ScopedVariable no_layers("VK_LAYER_PATH", "/nonexistent");
  DeviceOptions options;
  options.validate = true;
  const Result<Device> none = Device::create(options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "the validation layer VK_LAYER_KHRONOS_validation is not installed; install the package `vulkan-validationlayers`");
}

TEST_F(Engine, MissingExtensionsAreNamed) {
  RG_OPEN_DEVICE(device, false);
  EXPECT_FALSE(device.name().empty());
  DeviceOptions options;
  options.device_extensions = {"VK_RGC_nothing"};
  const Result<Device> none = Device::create(options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "the device lacks the extension VK_RGC_nothing");
}

TEST_F(Engine, AdoptedDevicesRunGraphsAndStayAlive) {
  RG_OPEN_DEVICE(device, false);
  void* library = dlopen("libvulkan.so.1", RTLD_NOW);
  ASSERT_NE(library, nullptr);
  ExternalDevice external;
  external.instance = device.state().instance, external.physical_device = device.physical(), external.device = device.handle();
  external.queue = device.queue(), external.queue_family = device.queue_family();
  EXPECT_EQ(Device::adopt(external).error().message, "an external device needs a VkDevice, a VkQueue and vkGetInstanceProcAddr");
  external.get_instance_proc_addr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  for (int round = 0; round < 2; ++round) {
    Result<Device> adopted = Device::adopt(external);
    ASSERT_TRUE(adopted) << adopted.error().message;
    EXPECT_EQ(adopted->name(), device.name());
    test::ClearAndCopy t = test::clear_and_copy();
    Result<GraphInstance> graph = GraphInstance::create(*adopted, t.plan.view(), {});
    ASSERT_TRUE(graph) << graph.error().message;
    RG_ASSERT_OK(graph->execute({}));
    expect_magenta(*graph, t.result);
  }
  dlclose(library);
}

TEST_F(Engine, InstancesOnTwoThreadsAreIndependent) {
  RG_OPEN_DEVICE(device, false);
  test::ClearAndCopy t = test::clear_and_copy();
  const Plan plan = t.plan.view();
  auto run = [&] {
    Result<GraphInstance> graph = GraphInstance::create(device, plan, {});
    ASSERT_TRUE(graph) << graph.error().message;
    for (int frame = 0; frame < 20; ++frame) RG_ASSERT_OK(graph->execute({}));
    expect_magenta(*graph, t.result);
  };
  std::thread other(run);
  run();
  other.join();
}

TEST_F(Engine, OnePlanRunsOnTwoDevices) {
  RG_OPEN_DEVICE(device, false);
  std::optional<Device> second = open(false);
  ASSERT_TRUE(second);
  EXPECT_NE(device.handle(), second->handle());
  test::ClearAndCopy t = test::clear_and_copy();
  const Plan plan = t.plan.view();
  auto run = [&](Device& on) {
    Result<GraphInstance> graph = GraphInstance::create(on, plan, {});
    ASSERT_TRUE(graph) << graph.error().message;
    for (int frame = 0; frame < 20; ++frame) RG_ASSERT_OK(graph->execute({}));
    expect_magenta(*graph, t.result);
  };
  std::thread other([&] { run(*second); });
  run(device);
  other.join();
}

TEST_F(Engine, MovedInstancesGoOn) {
  RG_OPEN_DEVICE(device, false);
  test::ClearAndCopy t = test::clear_and_copy();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  RG_ASSERT_OK(graph->execute({}));
  Device moved_device = std::move(device);  // outlives the instance, which must not notice
  GraphInstance moved = std::move(*graph);
  RG_ASSERT_OK(moved.execute({}));
  expect_magenta(moved, t.result);
  EXPECT_EQ(moved.frame(), 2u);
}

// ---- imports ------------------------------------------------------------------------------------------------------

struct OwnImage {
  UniqueMemory memory;
  UniqueImage image;
};

OwnImage make_image(Device& device, VkExtent3D extent, VkImageUsageFlags usage) {
  const DeviceFunctions& vk = device.vk();
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, info.imageType = VK_IMAGE_TYPE_2D, info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = extent, info.mipLevels = info.arrayLayers = 1, info.samples = VK_SAMPLE_COUNT_1_BIT, info.usage = usage;
  VkImage image = VK_NULL_HANDLE;
  EXPECT_EQ(vk.CreateImage(device.handle(), &info, nullptr, &image), VK_SUCCESS);
  VkMemoryRequirements requirements;
  vk.GetImageMemoryRequirements(device.handle(), image, &requirements);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocate.allocationSize = requirements.size;
  allocate.memoryTypeIndex = device.memory_type(requirements.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  EXPECT_EQ(vk.AllocateMemory(device.handle(), &allocate, nullptr, &memory), VK_SUCCESS);
  EXPECT_EQ(vk.BindImageMemory(device.handle(), image, memory, 0), VK_SUCCESS);
  return {UniqueMemory(vk, device.handle(), memory), UniqueImage(vk, device.handle(), image)};
}

void draw_to_imports(Device& device) {
  test::Tint t = test::tint();
  for (const Index index : {t.scene, t.final}) t.plan.resources[index].lifetime = Lifetime::imported, t.plan.resources[index].import_slot = index;
  std::vector<OwnImage> scenes, finals;
  for (int i = 0; i < 3; ++i) {
    scenes.push_back(make_image(device, {8, 4, 1}, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
    finals.push_back(make_image(device, {8, 4, 1}, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
  }
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  for (size_t frame = 0; frame < 7; ++frame) {
    Import imports[2];
    imports[t.scene].image.image = scenes[frame % 3].image.get(), imports[t.final].image.image = finals[frame % 3].image.get();
    FrameInputs inputs;
    inputs.callbacks = kIgnore, inputs.imports = imports;
    RG_ASSERT_OK(graph->execute(inputs));
    if (frame % 3 == 0) expect_magenta(*graph, t.result);
  }
}

TEST_F(Engine, ImportsRotateThroughClassicRenderPasses) {
  RG_OPEN_DEVICE(device, true);
  draw_to_imports(device);
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

TEST_F(Engine, ImportsRotateThroughDynamicRendering) {
  RG_OPEN_DEVICE(device, false);
  draw_to_imports(device);
}

}  // namespace
}  // namespace rg
