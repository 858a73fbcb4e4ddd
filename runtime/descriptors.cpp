#include "runtime/descriptors.h"

#include <algorithm>
#include <numeric>

#include "runtime/errors.h"
#include "runtime/resolve.h"
#include "runtime/resources.h"
#include "runtime/views.h"

namespace rg {

namespace {

bool is_image(DescriptorType type) {
  return type == DescriptorType::combined_image_sampler || type == DescriptorType::sampled_image || type == DescriptorType::storage_image ||
         type == DescriptorType::input_attachment;
}
bool is_buffer(DescriptorType type) { return type == DescriptorType::uniform_buffer || type == DescriptorType::storage_buffer; }

bool is_texels(DescriptorType type) { return type == DescriptorType::uniform_texel_buffer || type == DescriptorType::storage_texel_buffer; }

bool is_imported(const Sized& sized, const Binding& binding) {
  return binding.ref.resource != kNone && sized.resources[binding.ref.resource].count == 0;
}

std::span<const Binding> bindings_of(const Context& context, const Pass& pass) {
  return context.plan.bindings.subspan(pass.first_binding, pass.binding_count);
}

uint32_t set_period(const Context& context, const Sized& sized, const Pass& pass) {
  uint32_t period = 1;
  for (const Binding& binding : bindings_of(context, pass)) {
    if (binding.ref.resource == kNone) continue;
    period = std::lcm(period, is_imported(sized, binding) ? context.frames_in_flight : copies_of(sized, binding.ref.resource));
  }
  return period;
}

struct PoolSizes {
  std::vector<VkDescriptorPoolSize> rows;
  uint32_t sets = 0;
};

void count(PoolSizes& sizes, VkDescriptorType type, uint32_t amount) {
  const auto row = std::find_if(sizes.rows.begin(), sizes.rows.end(), [&](const VkDescriptorPoolSize& r) { return r.type == type; });
  if (row != sizes.rows.end())
    row->descriptorCount += amount;
  else
    sizes.rows.push_back({type, amount});
}

PoolSizes pool_sizes(const Context& context, const Sized& sized) {
  PoolSizes sizes;
  for (size_t i = 0; i < context.plan.passes.size(); ++i) {
    sizes.sets += sized.passes[i].set.period;
    for (const Binding& binding : bindings_of(context, context.plan.passes[i]))
      count(sizes, static_cast<VkDescriptorType>(binding.type), sized.passes[i].set.period);
  }
  return sizes;
}

Status create_pool(const Context& context, Sized& sized) {
  const PoolSizes sizes = pool_sizes(context, sized);
  if (sizes.sets == 0) return Done{};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = sizes.sets;
  info.poolSizeCount = static_cast<uint32_t>(sizes.rows.size());
  info.pPoolSizes = sizes.rows.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateDescriptorPool(context.device.device, &info, context.vk().allocator, &pool), "vkCreateDescriptorPool",
               context.plan.name));
  sized.descriptor_pool = UniqueDescriptorPool(context.vk(), context.device.device, pool);
  return Done{};
}

Status allocate_sets(const Context& context, Sized& sized, const PassObjects& pass, SetTable& table) {
  const std::vector<VkDescriptorSetLayout> layouts(table.period, pass.set_layout.get());
  table.sets.resize(table.period);
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = sized.descriptor_pool.get();
  info.descriptorSetCount = table.period;
  info.pSetLayouts = layouts.data();
  return check(context.vk().AllocateDescriptorSets(context.device.device, &info, table.sets.data()), "vkAllocateDescriptorSets", pass.name);
}

VkImageUsageFlags usage_of(DescriptorType type) {
  if (type == DescriptorType::storage_image) return VK_IMAGE_USAGE_STORAGE_BIT;
  return type == DescriptorType::input_attachment ? VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
}

VkDescriptorImageInfo image_info(const Objects& objects, const Binding& binding, VkImageView view) {
  return {binding.sampler == kNone ? VkSampler(VK_NULL_HANDLE) : objects.samplers[binding.sampler].get(), view,
          static_cast<VkImageLayout>(binding.layout)};
}

VkDescriptorBufferInfo buffer_info(const BufferSpan& span) { return {span.buffer, span.offset, span.size == 0 ? VK_WHOLE_SIZE : span.size}; }

VkWriteDescriptorSet write_header(VkDescriptorSet set, const Binding& binding) {
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set;
  write.dstBinding = binding.binding;
  write.descriptorCount = 1;
  write.descriptorType = static_cast<VkDescriptorType>(binding.type);
  return write;
}

// Contents of one binding in every set of the pass.
void write_image(const Context& context, const Objects& objects, const Sized& sized, const Binding& binding, const ViewRef& view,
                 const SetTable& table) {
  for (uint32_t phase = 0; phase < table.period; ++phase) {
    const VkDescriptorImageInfo info = image_info(objects, binding, view_at(sized, view, phase));
    VkWriteDescriptorSet write = write_header(table.sets[phase], binding);
    write.pImageInfo = &info;
    context.vk().UpdateDescriptorSets(context.device.device, 1, &write, 0, nullptr);
  }
}

void write_buffer(const Context& context, const Sized& sized, const Binding& binding, const SetTable& table) {
  for (uint32_t phase = 0; phase < table.period; ++phase) {
    const VkDescriptorBufferInfo info =
        binding.params != kNone ? VkDescriptorBufferInfo{sized.ring.buffer.get(), 0, context.plan.params[binding.params].bytes}
                                : buffer_info(buffer_at(sized, {}, context.plan, binding.ref, byte_range(context, sized, binding.bytes), phase));
    VkWriteDescriptorSet write = write_header(table.sets[phase], binding);
    write.pBufferInfo = &info;
    context.vk().UpdateDescriptorSets(context.device.device, 1, &write, 0, nullptr);
  }
}

// Views of texels are made once: the engine brings none.
Status write_texels(const Context& context, Sized& sized, const Binding& binding, const SetTable& table) {
  for (uint32_t phase = 0; phase < table.period; ++phase) {
    const VkDescriptorBufferInfo bytes =
        buffer_info(buffer_at(sized, {}, context.plan, binding.ref, byte_range(context, sized, binding.bytes), phase));
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = bytes.buffer;
    info.format = static_cast<VkFormat>(binding.view_format);
    info.offset = bytes.offset;
    info.range = bytes.range;
    VkBufferView view = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateBufferView(context.device.device, &info, context.vk().allocator, &view), "vkCreateBufferView",
                 context.plan.resources[binding.ref.resource].name));
    sized.buffer_views.emplace_back(context.vk(), context.device.device, view);
    VkWriteDescriptorSet write = write_header(table.sets[phase], binding);
    write.pTexelBufferView = &view;
    context.vk().UpdateDescriptorSets(context.device.device, 1, &write, 0, nullptr);
  }
  return Done{};
}

void add_imported(const Context& context, const Objects& objects, const Binding& binding, const ViewRef& view, SetTable& table) {
  ImportedBinding imported{&binding, view.imported, context.plan.resources[binding.ref.resource].import_slot, VK_NULL_HANDLE, {}};
  if (is_image(binding.type)) imported.sampler = image_info(objects, binding, VK_NULL_HANDLE).sampler;
  table.imported.push_back(imported);
}

Status fill_binding(const Context& context, const Objects& objects, Sized& sized, const Binding& binding, PassTable& pass) {
  ViewRef view;
  if (is_image(binding.type)) {
    Result<ViewRef> created =
        create_views(context, sized, {binding.ref, binding.range, binding.view, binding.arrayed, binding.view_format, usage_of(binding.type), false});
    if (!created) return created.error();
    view = *created;
    pass.runs &= view.exists;
    if (!view.exists) return Done{};
  }
  if (is_texels(binding.type)) return write_texels(context, sized, binding, pass.set);
  if (is_imported(sized, binding))
    add_imported(context, objects, binding, view, pass.set);
  else if (is_image(binding.type) || binding.type == DescriptorType::sampler)
    write_image(context, objects, sized, binding, view, pass.set);
  else
    write_buffer(context, sized, binding, pass.set);
  return Done{};
}

Status fill_sets(const Context& context, const Objects& objects, Sized& sized, const Pass& plan, PassTable& pass) {
  for (const Binding& binding : bindings_of(context, plan)) RG_TRY(fill_binding(context, objects, sized, binding, pass));
  SetTable& table = pass.set;
  for (ImportedBinding& imported : table.imported)
    if (is_buffer(imported.binding->type)) imported.bytes = byte_range(context, sized, imported.binding->bytes);
  table.written_images.resize(table.imported.size() * table.period);
  table.written_buffers.resize(table.imported.size() * table.period);
  for (const Index params : context.plan.pass_params.subspan(plan.first_params, plan.params_count))
    table.block_offsets.push_back(sized.ring.param_offsets[params]);
  table.dynamic_offsets = table.block_offsets;
  return Done{};
}

VkDeviceSize round_up(VkDeviceSize value, VkDeviceSize alignment) { return (value + alignment - 1) / alignment * alignment; }

VkDeviceSize lay_out_params(const Context& context, Ring& ring) {
  const VkDeviceSize alignment = std::max<VkDeviceSize>(context.device.limits.minUniformBufferOffsetAlignment, 16);
  VkDeviceSize end = 0;
  for (const Params& params : context.plan.params) {
    ring.param_offsets.push_back(static_cast<uint32_t>(end));
    end = round_up(end + params.bytes, alignment);
  }
  return end;
}

constexpr VkDeviceSize kMostRingBytes = VkDeviceSize{1} << 30;  // of a frame; offsets have 32 bits

VkDeviceSize lay_out_updates(Sized& sized, VkDeviceSize end) {
  constexpr VkDeviceSize kTexelAlignment = 16;  // of the largest texel or block that is copied
  for (const TransferRef& update : sized.updates) {
    TransferTable& transfer = sized.passes[update.pass].transfers[update.transfer];
    end = round_up(end, kTexelAlignment);
    transfer.upload_offset = static_cast<uint32_t>(end);
    end = transfer.upload_bytes > kMostRingBytes - std::min(end, kMostRingBytes) ? kMostRingBytes + 1 : end + transfer.upload_bytes;
  }
  return end;
}

bool same_image(const VkDescriptorImageInfo& a, const VkDescriptorImageInfo& b) { return a.imageView == b.imageView; }
bool same_buffer(const VkDescriptorBufferInfo& a, const VkDescriptorBufferInfo& b) {
  return a.buffer == b.buffer && a.offset == b.offset && a.range == b.range;
}

void update_binding(const Context& context, const Sized& sized, const std::vector<Import>& imports, SetTable& table, size_t i, uint32_t phase) {
  const ImportedBinding& imported = table.imported[i];
  VkWriteDescriptorSet write = write_header(table.sets[phase], *imported.binding);
  const size_t at = phase * table.imported.size() + i;
  if (imported.view != kNone) {
    const VkDescriptorImageInfo info{imported.sampler, sized.imported_views[imported.view].current,
                                     static_cast<VkImageLayout>(imported.binding->layout)};
    if (same_image(info, table.written_images[at])) return;
    table.written_images[at] = info;
    write.pImageInfo = &table.written_images[at];
  } else {
    const VkDescriptorBufferInfo info = buffer_info(buffer_at(sized, imports, context.plan, imported.binding->ref, imported.bytes, 0));
    if (same_buffer(info, table.written_buffers[at])) return;
    table.written_buffers[at] = info;
    write.pBufferInfo = &table.written_buffers[at];
  }
  context.vk().UpdateDescriptorSets(context.device.device, 1, &write, 0, nullptr);
}

void forget_replaced(const Sized& sized, SetTable& table) {
  for (size_t at = 0; at < table.written_images.size(); ++at) {
    const Index view = table.imported[at % table.imported.size()].view;
    if (view != kNone && sized.imported_views[view].replaced) table.written_images[at] = {};
  }
}

}  // namespace

Status create_ring(const Context& context, Sized& sized) {
  const VkDeviceSize used = lay_out_updates(sized, lay_out_params(context, sized.ring));
  if (used == 0) return Done{};
  if (used > kMostRingBytes)
    return Error{ErrorCode::unsupported,
                 "graph `" + std::string(context.plan.name) + "`: updates and parameter blocks of a frame need more than 1 GiB"};
  sized.ring.section = round_up(used, std::max<VkDeviceSize>(context.device.limits.minUniformBufferOffsetAlignment, 256));
  constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  const VkDeviceSize bytes = sized.ring.section * context.frames_in_flight;
  Result<HostBuffer> buffer = create_host_buffer(context, bytes, usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "parameter ring");
  if (!buffer) return buffer.error();
  sized.ring.memory = std::move(buffer->memory);
  sized.ring.buffer = std::move(buffer->buffer);
  sized.ring.mapped = buffer->mapped;
  sized.report.host_bytes += bytes;
  return Done{};
}

Status create_sets(const Context& context, const Objects& objects, Sized& sized) {
  for (size_t i = 0; i < sized.passes.size(); ++i)
    if (context.plan.passes[i].binding_count != 0) sized.passes[i].set.period = set_period(context, sized, context.plan.passes[i]);
  RG_TRY(create_pool(context, sized));
  for (size_t i = 0; i < sized.passes.size(); ++i) {
    if (sized.passes[i].set.period == 0) continue;
    RG_TRY(allocate_sets(context, sized, objects.passes[i], sized.passes[i].set));
    RG_TRY(fill_sets(context, objects, sized, context.plan.passes[i], sized.passes[i]));
    if (sized.passes[i].runs && !sized.passes[i].set.imported.empty()) sized.imported_sets.push_back(static_cast<Index>(i));
  }
  return Done{};
}

void update_imported_bindings(const Context& context, Sized& sized, const std::vector<Import>& imports, uint64_t frame) {
  for (const Index index : sized.imported_sets) {
    PassTable& pass = sized.passes[index];
    const uint32_t phase = static_cast<uint32_t>(frame % pass.set.period);
    forget_replaced(sized, pass.set);
    for (size_t i = 0; i < pass.set.imported.size(); ++i) update_binding(context, sized, imports, pass.set, i, phase);
  }
  for (ImportedView& view : sized.imported_views) view.replaced = false;
}

}  // namespace rg
