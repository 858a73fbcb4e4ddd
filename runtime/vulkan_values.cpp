// plan.h carries Vulkan's numbers without including Vulkan: here they are held together.
#include <vulkan/vulkan_core.h>

#include "runtime/plan.h"

namespace rg {

#define RG_STAGE(ours, theirs) static_assert(stage::ours == VK_PIPELINE_STAGE_2_##theirs)
RG_STAGE(none, NONE);
RG_STAGE(draw_indirect, DRAW_INDIRECT_BIT);
RG_STAGE(vertex_shader, VERTEX_SHADER_BIT);
RG_STAGE(tess_control_shader, TESSELLATION_CONTROL_SHADER_BIT);
RG_STAGE(tess_eval_shader, TESSELLATION_EVALUATION_SHADER_BIT);
RG_STAGE(geometry_shader, GEOMETRY_SHADER_BIT);
RG_STAGE(fragment_shader, FRAGMENT_SHADER_BIT);
RG_STAGE(early_fragment_tests, EARLY_FRAGMENT_TESTS_BIT);
RG_STAGE(late_fragment_tests, LATE_FRAGMENT_TESTS_BIT);
RG_STAGE(color_attachment_output, COLOR_ATTACHMENT_OUTPUT_BIT);
RG_STAGE(compute_shader, COMPUTE_SHADER_BIT);
RG_STAGE(all_transfer, ALL_TRANSFER_BIT);
RG_STAGE(bottom_of_pipe, BOTTOM_OF_PIPE_BIT);
RG_STAGE(host, HOST_BIT);
RG_STAGE(all_graphics, ALL_GRAPHICS_BIT);
RG_STAGE(all_commands, ALL_COMMANDS_BIT);
RG_STAGE(copy, COPY_BIT);
RG_STAGE(resolve, RESOLVE_BIT);
RG_STAGE(blit, BLIT_BIT);
RG_STAGE(clear, CLEAR_BIT);
RG_STAGE(index_input, INDEX_INPUT_BIT);
RG_STAGE(vertex_attribute_input, VERTEX_ATTRIBUTE_INPUT_BIT);
#undef RG_STAGE

#define RG_ACCESS(ours, theirs) static_assert(access::ours == VK_ACCESS_2_##theirs)
RG_ACCESS(none, NONE);
RG_ACCESS(indirect_command_read, INDIRECT_COMMAND_READ_BIT);
RG_ACCESS(index_read, INDEX_READ_BIT);
RG_ACCESS(vertex_attribute_read, VERTEX_ATTRIBUTE_READ_BIT);
RG_ACCESS(uniform_read, UNIFORM_READ_BIT);
RG_ACCESS(input_attachment_read, INPUT_ATTACHMENT_READ_BIT);
RG_ACCESS(shader_read, SHADER_READ_BIT);
RG_ACCESS(shader_write, SHADER_WRITE_BIT);
RG_ACCESS(color_attachment_read, COLOR_ATTACHMENT_READ_BIT);
RG_ACCESS(color_attachment_write, COLOR_ATTACHMENT_WRITE_BIT);
RG_ACCESS(depth_stencil_attachment_read, DEPTH_STENCIL_ATTACHMENT_READ_BIT);
RG_ACCESS(depth_stencil_attachment_write, DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
RG_ACCESS(transfer_read, TRANSFER_READ_BIT);
RG_ACCESS(transfer_write, TRANSFER_WRITE_BIT);
RG_ACCESS(host_read, HOST_READ_BIT);
RG_ACCESS(host_write, HOST_WRITE_BIT);
RG_ACCESS(memory_read, MEMORY_READ_BIT);
RG_ACCESS(memory_write, MEMORY_WRITE_BIT);
RG_ACCESS(shader_sampled_read, SHADER_SAMPLED_READ_BIT);
RG_ACCESS(shader_storage_read, SHADER_STORAGE_READ_BIT);
RG_ACCESS(shader_storage_write, SHADER_STORAGE_WRITE_BIT);
#undef RG_ACCESS

#define RG_VALUE(ours, theirs) static_assert(static_cast<int64_t>(ours) == static_cast<int64_t>(theirs))
#define RG_LAYOUT(ours, theirs) RG_VALUE(Layout::ours, VK_IMAGE_LAYOUT_##theirs)
RG_LAYOUT(undefined, UNDEFINED);
RG_LAYOUT(general, GENERAL);
RG_LAYOUT(color_attachment, COLOR_ATTACHMENT_OPTIMAL);
RG_LAYOUT(depth_stencil_attachment, DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
RG_LAYOUT(depth_stencil_read_only, DEPTH_STENCIL_READ_ONLY_OPTIMAL);
RG_LAYOUT(shader_read_only, SHADER_READ_ONLY_OPTIMAL);
RG_LAYOUT(transfer_src, TRANSFER_SRC_OPTIMAL);
RG_LAYOUT(transfer_dst, TRANSFER_DST_OPTIMAL);
RG_LAYOUT(depth_read_only_stencil_attachment, DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL);
RG_LAYOUT(depth_attachment_stencil_read_only, DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL);
RG_LAYOUT(depth_attachment, DEPTH_ATTACHMENT_OPTIMAL);
RG_LAYOUT(depth_read_only, DEPTH_READ_ONLY_OPTIMAL);
RG_LAYOUT(stencil_attachment, STENCIL_ATTACHMENT_OPTIMAL);
RG_LAYOUT(stencil_read_only, STENCIL_READ_ONLY_OPTIMAL);
RG_LAYOUT(present_src, PRESENT_SRC_KHR);
#undef RG_LAYOUT

RG_VALUE(kRemaining, VK_REMAINING_MIP_LEVELS);
RG_VALUE(kRemaining, VK_REMAINING_ARRAY_LAYERS);
RG_VALUE(aspect_color, VK_IMAGE_ASPECT_COLOR_BIT);
RG_VALUE(aspect_depth, VK_IMAGE_ASPECT_DEPTH_BIT);
RG_VALUE(aspect_stencil, VK_IMAGE_ASPECT_STENCIL_BIT);

RG_VALUE(DescriptorType::sampler, VK_DESCRIPTOR_TYPE_SAMPLER);
RG_VALUE(DescriptorType::combined_image_sampler, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
RG_VALUE(DescriptorType::sampled_image, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
RG_VALUE(DescriptorType::storage_image, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
RG_VALUE(DescriptorType::uniform_texel_buffer, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
RG_VALUE(DescriptorType::storage_texel_buffer, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER);
RG_VALUE(DescriptorType::uniform_buffer, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
RG_VALUE(DescriptorType::storage_buffer, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
RG_VALUE(DescriptorType::uniform_buffer_dynamic, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC);
RG_VALUE(DescriptorType::input_attachment, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT);

RG_VALUE(ShaderStage::vertex, VK_SHADER_STAGE_VERTEX_BIT);
RG_VALUE(ShaderStage::tess_control, VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT);
RG_VALUE(ShaderStage::tess_eval, VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT);
RG_VALUE(ShaderStage::geometry, VK_SHADER_STAGE_GEOMETRY_BIT);
RG_VALUE(ShaderStage::fragment, VK_SHADER_STAGE_FRAGMENT_BIT);
RG_VALUE(ShaderStage::compute, VK_SHADER_STAGE_COMPUTE_BIT);

RG_VALUE(BlendFactor::zero, VK_BLEND_FACTOR_ZERO);
RG_VALUE(BlendFactor::one, VK_BLEND_FACTOR_ONE);
RG_VALUE(BlendFactor::src_color, VK_BLEND_FACTOR_SRC_COLOR);
RG_VALUE(BlendFactor::one_minus_src_color, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR);
RG_VALUE(BlendFactor::dst_color, VK_BLEND_FACTOR_DST_COLOR);
RG_VALUE(BlendFactor::one_minus_dst_color, VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR);
RG_VALUE(BlendFactor::src_alpha, VK_BLEND_FACTOR_SRC_ALPHA);
RG_VALUE(BlendFactor::one_minus_src_alpha, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
RG_VALUE(BlendFactor::dst_alpha, VK_BLEND_FACTOR_DST_ALPHA);
RG_VALUE(BlendFactor::one_minus_dst_alpha, VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA);
RG_VALUE(BlendOp::add, VK_BLEND_OP_ADD);
RG_VALUE(BlendOp::subtract, VK_BLEND_OP_SUBTRACT);
RG_VALUE(BlendOp::reverse_subtract, VK_BLEND_OP_REVERSE_SUBTRACT);
RG_VALUE(BlendOp::min, VK_BLEND_OP_MIN);
RG_VALUE(BlendOp::max, VK_BLEND_OP_MAX);
RG_VALUE(Compare::never, VK_COMPARE_OP_NEVER);
RG_VALUE(Compare::less, VK_COMPARE_OP_LESS);
RG_VALUE(Compare::equal, VK_COMPARE_OP_EQUAL);
RG_VALUE(Compare::less_equal, VK_COMPARE_OP_LESS_OR_EQUAL);
RG_VALUE(Compare::greater, VK_COMPARE_OP_GREATER);
RG_VALUE(Compare::not_equal, VK_COMPARE_OP_NOT_EQUAL);
RG_VALUE(Compare::greater_equal, VK_COMPARE_OP_GREATER_OR_EQUAL);
RG_VALUE(Compare::always, VK_COMPARE_OP_ALWAYS);
#undef RG_VALUE

}  // namespace rg
