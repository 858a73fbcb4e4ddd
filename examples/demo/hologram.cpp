#include "examples/demo/hologram.h"

#include <span>

#include "examples/demo/upload.h"
#include "hologram.frag.h"
#include "hologram.vert.h"

namespace rg::demo {
namespace {

UniqueShader make_shader(Device& device, std::span<const uint32_t> words) {
  const VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
  VkShaderModule handle = VK_NULL_HANDLE;
  device.vk().CreateShaderModule(device.handle(), &info, nullptr, &handle);
  return UniqueShader(device.vk(), device.handle(), handle);
}

VkPipelineColorBlendAttachmentState additive() {
  VkPipelineColorBlendAttachmentState blend{};
  blend.blendEnable = VK_TRUE;
  blend.srcColorBlendFactor = blend.dstColorBlendFactor = blend.srcAlphaBlendFactor = blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return blend;
}

}  // namespace

Result<UniquePipeline> make_hologram_pipeline(Device& device, const PassInfo& pass) {
  const UniqueShader vertex = make_shader(device, kHologramVertexWords), fragment = make_shader(device, kHologramFragmentWords);
  if (!vertex || !fragment) return Error{ErrorCode::driver, "the hologram's shaders are rejected by the driver"};
  VkPipelineShaderStageCreateInfo stages[2] = {vulkan_struct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO),
                                               vulkan_struct<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO)};
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertex.get();
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = fragment.get();
  stages[0].pName = stages[1].pName = "main";

  const auto input = vulkan_struct<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  auto assembly = vulkan_struct<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
  auto viewport = vulkan_struct<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  viewport.viewportCount = viewport.scissorCount = 1;
  auto raster = vulkan_struct<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.lineWidth = 1;
  auto samples = vulkan_struct<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = pass.samples;
  auto depth = vulkan_struct<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
  const VkPipelineColorBlendAttachmentState attachment = additive();
  auto blend = vulkan_struct<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = 1;
  blend.pAttachments = &attachment;
  const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  auto dynamic = vulkan_struct<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = dynamic_states;
  auto rendering = vulkan_struct<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  rendering.viewMask = pass.view_mask;
  rendering.colorAttachmentCount = static_cast<uint32_t>(pass.color_formats.size());
  rendering.pColorAttachmentFormats = pass.color_formats.data();
  rendering.depthAttachmentFormat = pass.depth_format;
  rendering.stencilAttachmentFormat = pass.stencil_format;

  auto info = vulkan_struct<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.pNext = pass.render_pass == VK_NULL_HANDLE ? &rendering : nullptr;
  info.renderPass = pass.render_pass;
  info.layout = pass.layout;
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult result = device.vk().CreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &handle);
  if (result != VK_SUCCESS) return Error{ErrorCode::driver, "the hologram's pipeline cannot be created: " + std::to_string(result)};
  return UniquePipeline(device.vk(), device.handle(), handle);
}

}  // namespace rg::demo
