#include "runtime/make_pipeline.h"

#include "runtime/errors.h"
#include "runtime/resources.h"

namespace rg {

namespace {

Status create_shader(const Context& context, Index index, Shaders& shaders) {
  if (shaders[index]) return Done{};
  const ShaderModule& module = context.plan.shaders[index];
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = module.words.size_bytes();
  info.pCode = module.words.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateShaderModule(context.device.device, &info, context.vk().allocator, &shader), "vkCreateShaderModule", module.name));
  shaders[index] = UniqueShader(context.vk(), context.device.device, shader);
  return Done{};
}

using StageInfos = std::vector<VkPipelineShaderStageCreateInfo>;
std::span<const Index> shaders_of(const Plan& plan, const Pipeline& pipeline) {
  return plan.pipeline_shaders.subspan(pipeline.first_shader, pipeline.shader_count);
}

StageInfos shader_stages(const Plan& plan, const Pipeline& pipeline, const Shaders& shaders) {
  StageInfos stages;
  for (const Index shader : shaders_of(plan, pipeline)) {
    VkPipelineShaderStageCreateInfo& stage = stages.emplace_back();
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.stage = static_cast<VkShaderStageFlagBits>(plan.shaders[shader].stage);
    stage.module = shaders[shader].get();
    stage.pName = "main";
  }
  return stages;
}

VkPipelineColorBlendAttachmentState blend_state(const ColorBlend& blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.blendEnable = blend.enabled ? VK_TRUE : VK_FALSE;
  state.srcColorBlendFactor = static_cast<VkBlendFactor>(blend.src);
  state.dstColorBlendFactor = static_cast<VkBlendFactor>(blend.dst);
  state.colorBlendOp = static_cast<VkBlendOp>(blend.op);
  state.srcAlphaBlendFactor = static_cast<VkBlendFactor>(blend.src_alpha);
  state.dstAlphaBlendFactor = static_cast<VkBlendFactor>(blend.dst_alpha);
  state.alphaBlendOp = static_cast<VkBlendOp>(blend.op_alpha);
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return state;
}

// The fixed-function state of a graphics pipeline; points into itself, so it is filled in place.
struct GraphicsState {
  std::vector<VkVertexInputBindingDescription> vertex_bindings;
  std::vector<VkVertexInputAttributeDescription> vertex_attributes;
  std::vector<VkPipelineColorBlendAttachmentState> blends;
  VkPipelineVertexInputStateCreateInfo vertex_input{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineTessellationStateCreateInfo tessellation{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationStateCreateInfo raster{};
  VkPipelineRasterizationConservativeStateCreateInfoEXT conservative{};
  VkPipelineMultisampleStateCreateInfo multisample{};
  VkPipelineSampleLocationsStateCreateInfoEXT locations{};
  std::vector<VkSampleLocationEXT> sample_locations;
  VkPipelineDepthStencilStateCreateInfo depth{};
  VkPipelineColorBlendStateCreateInfo blend{};
  VkPipelineDynamicStateCreateInfo dynamic{};
  VkPipelineRenderingCreateInfo rendering{};
};

void fill_vertex_input(const Plan& plan, const Pipeline& pipeline, GraphicsState& state) {
  for (uint32_t i = 0; i < pipeline.vertex_binding_count; ++i) {
    const VertexBinding& binding = plan.vertex_bindings[pipeline.first_vertex_binding + i];
    state.vertex_bindings.push_back({i, binding.stride, binding.per_instance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX});
  }
  for (const VertexAttribute& attribute : plan.vertex_attributes.subspan(pipeline.first_vertex_attribute, pipeline.vertex_attribute_count))
    state.vertex_attributes.push_back({attribute.location, attribute.binding, static_cast<VkFormat>(attribute.format), attribute.offset});
  state.vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  state.vertex_input.vertexBindingDescriptionCount = static_cast<uint32_t>(state.vertex_bindings.size());
  state.vertex_input.pVertexBindingDescriptions = state.vertex_bindings.data();
  state.vertex_input.vertexAttributeDescriptionCount = static_cast<uint32_t>(state.vertex_attributes.size());
  state.vertex_input.pVertexAttributeDescriptions = state.vertex_attributes.data();
  state.assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  state.assembly.topology = static_cast<VkPrimitiveTopology>(pipeline.raster.topology);
  state.tessellation.sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO;
  state.tessellation.patchControlPoints = 3;
}

VkStencilOpState stencil_state(const StencilFace& face) {
  return {static_cast<VkStencilOp>(face.fail),
          static_cast<VkStencilOp>(face.pass),
          static_cast<VkStencilOp>(face.depth_fail),
          static_cast<VkCompareOp>(face.compare),
          face.read_mask,
          face.write_mask,
          face.reference};
}

void fill_raster(const Pipeline& pipeline, const Rendering& rendering, GraphicsState& state) {
  const RasterState& in = pipeline.raster;
  state.viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  state.viewport.viewportCount = state.viewport.scissorCount = 1;
  state.raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  state.raster.cullMode = in.cull;
  state.raster.frontFace = in.front_clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
  state.raster.depthBiasEnable = in.depth_bias_constant != 0 || in.depth_bias_slope != 0 ? VK_TRUE : VK_FALSE;
  state.raster.depthBiasConstantFactor = in.depth_bias_constant;
  state.raster.depthBiasSlopeFactor = in.depth_bias_slope;
  state.raster.lineWidth = 1;
  state.multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  state.multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(rendering.samples);
  state.multisample.alphaToCoverageEnable = in.alpha_to_coverage ? VK_TRUE : VK_FALSE;
  state.depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  state.depth.depthTestEnable = in.depth_test ? VK_TRUE : VK_FALSE;
  state.depth.depthWriteEnable = in.depth_write ? VK_TRUE : VK_FALSE;
  state.depth.depthCompareOp = static_cast<VkCompareOp>(in.depth_compare);
  state.depth.stencilTestEnable = in.stencil_test ? VK_TRUE : VK_FALSE;
  state.depth.front = stencil_state(in.stencil_front);
  state.depth.back = stencil_state(in.stencil_back);
}

// What the device has been asked for, see fits_device.
void fill_device_state(const Plan& plan, const RasterState& in, const Rendering& rendering, GraphicsState& state) {
  state.depth.depthBoundsTestEnable = in.depth_bounds ? VK_TRUE : VK_FALSE;
  state.depth.minDepthBounds = in.depth_min;
  state.depth.maxDepthBounds = in.depth_max;
  if (in.conservative) {
    state.conservative.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT;
    state.conservative.conservativeRasterizationMode = VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT;
    state.raster.pNext = &state.conservative;
  }
  if (in.sample_location_count == 0) return;
  for (const SampleLocation& at : plan.sample_locations.subspan(in.first_sample_location, in.sample_location_count))
    state.sample_locations.push_back({at.x, at.y});
  state.locations.sType = VK_STRUCTURE_TYPE_PIPELINE_SAMPLE_LOCATIONS_STATE_CREATE_INFO_EXT;
  state.locations.sampleLocationsEnable = VK_TRUE;
  state.locations.sampleLocationsInfo = {VK_STRUCTURE_TYPE_SAMPLE_LOCATIONS_INFO_EXT,           nullptr,
                                         static_cast<VkSampleCountFlagBits>(rendering.samples), {1, 1},
                                         static_cast<uint32_t>(state.sample_locations.size()),  state.sample_locations.data()};
  state.multisample.pNext = &state.locations;
}

void fill_blend(const Plan& plan, const Pipeline& pipeline, const Rendering& rendering, GraphicsState& state) {
  for (uint32_t i = 0; i < rendering.color_count; ++i)
    state.blends.push_back(blend_state(i < pipeline.blend_count ? plan.blends[pipeline.first_blend + i] : ColorBlend{}));
  state.blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  state.blend.attachmentCount = static_cast<uint32_t>(state.blends.size());
  state.blend.pAttachments = state.blends.data();
  static constexpr VkDynamicState kDynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  state.dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  state.dynamic.dynamicStateCount = 2;
  state.dynamic.pDynamicStates = kDynamic;
}

void fill_rendering(const Context& context, const Rendering& rendering, const PassObjects& pass, GraphicsState& state) {
  auto format = [&](Index attachment) {
    return attachment == kNone ? VK_FORMAT_UNDEFINED
                               : static_cast<VkFormat>(context.plan.resources[context.plan.attachments[attachment].ref.resource].format);
  };
  state.rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  state.rendering.viewMask = rendering.view_mask;
  state.rendering.colorAttachmentCount = static_cast<uint32_t>(pass.color_formats.size());
  state.rendering.pColorAttachmentFormats = pass.color_formats.data();
  state.rendering.depthAttachmentFormat = format(rendering.depth);
  state.rendering.stencilAttachmentFormat = format(rendering.stencil);
}

Result<VkPipeline> create_graphics(const Context& context, const Pipeline& pipeline, const Rendering& rendering, const PassObjects& pass,
                                   const StageInfos& stages) {
  GraphicsState state;
  fill_vertex_input(context.plan, pipeline, state);
  fill_raster(pipeline, rendering, state);
  fill_device_state(context.plan, pipeline.raster, rendering, state);
  fill_blend(context.plan, pipeline, rendering, state);
  fill_rendering(context, rendering, pass, state);
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = pass.render_pass ? nullptr : &state.rendering;
  info.renderPass = pass.render_pass.get();
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &state.vertex_input;
  info.pInputAssemblyState = &state.assembly;
  info.pTessellationState = &state.tessellation;
  info.pViewportState = &state.viewport;
  info.pRasterizationState = &state.raster;
  info.pMultisampleState = &state.multisample;
  info.pDepthStencilState = &state.depth;
  info.pColorBlendState = &state.blend;
  info.pDynamicState = &state.dynamic;
  info.layout = pass.layout.get();
  VkPipeline handle = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateGraphicsPipelines(context.device.device, context.device.pipeline_cache, 1, &info, context.vk().allocator, &handle),
               "vkCreateGraphicsPipelines", pass.name));
  return handle;
}

Result<VkPipeline> create_compute(const Context& context, const PassObjects& pass, const StageInfos& stages) {
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = stages[0];
  info.layout = pass.layout.get();
  VkPipeline handle = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateComputePipelines(context.device.device, context.device.pipeline_cache, 1, &info, context.vk().allocator, &handle),
               "vkCreateComputePipelines", pass.name));
  return handle;
}

}  // namespace

Status create_shaders(const Context& context, Index pipeline, Shaders& shaders) {
  for (const Index shader : shaders_of(context.plan, context.plan.pipelines[pipeline])) RG_TRY(create_shader(context, shader, shaders));
  return Done{};
}

Result<UniquePipeline> make_pipeline(const Context& context, const Pass& pass, Index index, const Shaders& shaders, const PassObjects& out) {
  const Pipeline& pipeline = context.plan.pipelines[index];
  const StageInfos stages = shader_stages(context.plan, pipeline, shaders);
  const bool graphics = pass.rendering != kNone;
  const Result<VkPipeline> handle =
      graphics ? create_graphics(context, pipeline, context.plan.renderings[pass.rendering], out, stages) : create_compute(context, out, stages);
  if (!handle) return handle.error();
  name_object(context.device, VK_OBJECT_TYPE_PIPELINE, *handle, out.name);
  return UniquePipeline(context.vk(), context.device.device, *handle);
}

}  // namespace rg
