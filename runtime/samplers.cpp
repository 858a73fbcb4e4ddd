#include "runtime/samplers.h"

#include <algorithm>

#include "runtime/errors.h"

namespace rg {

namespace {

VkSamplerCreateInfo sampler_info(const Context& context, const Sampler& sampler) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = info.minFilter = sampler.linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  info.mipmapMode = sampler.mip_linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW = static_cast<VkSamplerAddressMode>(sampler.address);
  info.anisotropyEnable = sampler.max_anisotropy > 1 && context.device.sampler_anisotropy ? VK_TRUE : VK_FALSE;
  info.maxAnisotropy = std::clamp(sampler.max_anisotropy, 1.0f, std::max(context.device.limits.maxSamplerAnisotropy, 1.0f));
  info.compareEnable = sampler.compare_enabled ? VK_TRUE : VK_FALSE;
  info.compareOp = static_cast<VkCompareOp>(sampler.compare);
  info.maxLod = VK_LOD_CLAMP_NONE;
  return info;
}

}  // namespace

Status create_samplers(const Context& context, Objects& objects) {
  for (const Sampler& sampler : context.plan.samplers) {
    const VkSamplerCreateInfo info = sampler_info(context, sampler);
    VkSampler handle = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateSampler(context.device.device, &info, context.vk().allocator, &handle), "vkCreateSampler", sampler.name));
    objects.samplers.emplace_back(context.vk(), context.device.device, handle);
  }
  return Done{};
}

}  // namespace rg
