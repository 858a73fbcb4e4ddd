// Descriptor sets of an engine's own, beside those of the passes: another one every frame, on a real driver under validation.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "runtime/graph.h"
#include "runtime/handles.h"
#include "tests/unit/e2e/run_frame.h"

namespace rg::test {
namespace {

// shown[i] = words of table 0 plus those of table 1, doubled where the material says so.
const Files kTables = {{"frame.rg", R"(
set tables 0 { readonly buffer Table { uint words[64]; } tables[2]; }
set look 2   { uniform Look { uint factor; } look; }
graph frame() {
  buffer sums : u32[64]
  buffer shown : u32[64] readback
  pass add : compute { shader "add.comp" group 64 1 1  bind tables  write sums as storage  dispatch groups 1 }
  pass scale : compute { shader "scale.comp" group 64 1 1  bind look  read sums as storage  write shown as storage  dispatch groups 1 }
})"},
                       {"add.comp", R"(void main() {
  uint i = gl_GlobalInvocationID.x;
  sums[i] = tables[0].words[i] + tables[1].words[i];
})"},
                       {"scale.comp", R"(void main() {
  uint i = gl_GlobalInvocationID.x;
  shown[i] = sums[i] * look.factor;
})"}};

// What an engine has: layouts, and sets of them over buffers that it fills.
class Sets {
 public:
  explicit Sets(Device& device) : device_(device) {
    tables_layout = make_layout(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2);
    look_layout = make_layout(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1);
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8}, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 8}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, info.maxSets = 8, info.poolSizeCount = 2, info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    EXPECT_EQ(device.vk().CreateDescriptorPool(device.handle(), &info, nullptr, &pool), VK_SUCCESS);
    pool_ = UniqueDescriptorPool(device.vk(), device.handle(), pool);
  }

  VkBuffer make_buffer(VkBufferUsageFlags usage, const Words& words) {
    const DeviceFunctions& vk = device_.vk();
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, info.size = words.size() * 4, info.usage = usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    EXPECT_EQ(vk.CreateBuffer(device_.handle(), &info, nullptr, &buffer), VK_SUCCESS);
    buffers_.emplace_back(vk, device_.handle(), buffer);
    VkMemoryRequirements wanted;
    vk.GetBufferMemoryRequirements(device_.handle(), buffer, &wanted);
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, allocate.allocationSize = wanted.size;
    allocate.memoryTypeIndex = device_.memory_type(wanted.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    EXPECT_EQ(vk.AllocateMemory(device_.handle(), &allocate, nullptr, &memory), VK_SUCCESS);
    memory_.emplace_back(vk, device_.handle(), memory);
    EXPECT_EQ(vk.BindBufferMemory(device_.handle(), buffer, memory, 0), VK_SUCCESS);
    void* mapped = nullptr;
    EXPECT_EQ(vk.MapMemory(device_.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped), VK_SUCCESS);
    std::memcpy(mapped, words.data(), words.size() * 4);
    return buffer;
  }

  VkDescriptorSet make_set(VkDescriptorSetLayout layout, VkDescriptorType type, const std::vector<VkBuffer>& buffers) {
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, info.descriptorPool = pool_.get(), info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    EXPECT_EQ(device_.vk().AllocateDescriptorSets(device_.handle(), &info, &set), VK_SUCCESS);
    std::vector<VkDescriptorBufferInfo> rows;
    for (VkBuffer buffer : buffers) rows.push_back({buffer, 0, VK_WHOLE_SIZE});
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = set, write.descriptorType = type;
    write.descriptorCount = static_cast<uint32_t>(rows.size()), write.pBufferInfo = rows.data();
    device_.vk().UpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    return set;
  }

  UniqueSetLayout tables_layout, look_layout;

 private:
  UniqueSetLayout make_layout(VkDescriptorType type, uint32_t count) {
    const VkDescriptorSetLayoutBinding binding{0, type, count, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, info.bindingCount = 1, info.pBindings = &binding;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    EXPECT_EQ(device_.vk().CreateDescriptorSetLayout(device_.handle(), &info, nullptr, &layout), VK_SUCCESS);
    return UniqueSetLayout(device_.vk(), device_.handle(), layout);
  }
  Device& device_;
  UniqueDescriptorPool pool_;
  std::vector<UniqueMemory> memory_;
  std::vector<UniqueBuffer> buffers_;
};

Words counting(uint32_t first) {
  Words words(64);
  for (uint32_t i = 0; i < 64; ++i) words[i] = first + i;
  return words;
}

TEST(EngineSets, AreBoundBesideThoseOfThePassAndMayChangeEveryFrame) {
  const compiler::CompileResult result = compile_files(kTables);
  ASSERT_FALSE(result.graphs.empty());
  expect_proved(result);
  const Plan plan = result.graphs[0].plans[0].plan.view();
  ASSERT_EQ(plan.engine_sets.size(), 2u);
  std::string messages;
  DeviceOptions options;
  options.validate = true;
  options.on_message = [&](bool, std::string_view message) { messages += std::string(message) + "\n"; };
  auto device = Device::create(options);
  if (!device && std::getenv("RGC_REQUIRE_GPU") == nullptr) GTEST_SKIP() << device.error().message;
  ASSERT_TRUE(device) << device.error().message;
  {
    Sets sets(*device);
    const bool tables_first = plan.engine_sets[0].name == "tables";
    std::array<VkDescriptorSetLayout, 2> layouts = {sets.tables_layout.get(), sets.look_layout.get()};
    if (!tables_first) std::swap(layouts[0], layouts[1]);
    EXPECT_EQ(GraphInstance::create(*device, plan, {}).error().message, "graph `frame` uses 2 engine sets; layouts given: 0");
    GraphOptions graph_options;
    graph_options.engine_set_layouts = layouts;
    auto graph = GraphInstance::create(*device, plan, graph_options);
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_EQ(graph->execute({}).error().code, ErrorCode::invalid_argument) << "no sets";
    const VkBuffer ones = sets.make_buffer(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, counting(1)),
                   tens = sets.make_buffer(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, counting(10)),
                   more = sets.make_buffer(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, counting(1000));
    const VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, uniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    const VkDescriptorSet tables[] = {sets.make_set(sets.tables_layout.get(), storage, {ones, tens}),
                                      sets.make_set(sets.tables_layout.get(), storage, {tens, more})};
    const VkDescriptorSet looks[] = {
        sets.make_set(sets.look_layout.get(), uniform, {sets.make_buffer(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, {2, 0, 0, 0})}),
        sets.make_set(sets.look_layout.get(), uniform, {sets.make_buffer(VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, {3, 0, 0, 0})})};
    Index shown = 0;
    while (plan.resources[shown].lifetime != Lifetime::readback) ++shown;
    for (uint32_t frame = 0; frame < 4; ++frame) {
      const uint32_t table = frame % 2, look = frame / 2;
      std::array<VkDescriptorSet, 2> given = {tables[table], looks[look]};
      if (!tables_first) std::swap(given[0], given[1]);
      FrameInputs inputs;
      inputs.engine_sets = given;
      const Status done = graph->execute(inputs);
      ASSERT_TRUE(done) << done.error().message;
      const auto bytes = graph->readback(shown);
      ASSERT_TRUE(bytes) << bytes.error().message;
      Words words(64), right(64);
      ASSERT_EQ(bytes->size(), 256u);
      std::memcpy(words.data(), bytes->data(), 256);
      for (uint32_t i = 0; i < 64; ++i) right[i] = ((table == 0 ? 11 : 1010) + 2 * i) * (2 + look);
      EXPECT_EQ(words, right) << "frame " << frame;
    }
    ASSERT_TRUE(graph->wait_idle());
  }
  EXPECT_EQ(messages, "");
}

}  // namespace
}  // namespace rg::test
