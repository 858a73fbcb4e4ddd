#include "compiler/verify/vulkan_model.h"

#include <array>
#include <bit>

namespace rg::verify {
namespace {

struct StageRow {
  const char* name;
  Stages raw;
  StageSet earlier;
  AccessSet accesses;
};

constexpr AccessSet kShaderAccess = access_bit(kUniformRead) | access_bit(kSampledRead) | access_bit(kStorageRead) | access_bit(kStorageWrite);
constexpr AccessSet kTransferAccess = access_bit(kTransferRead) | access_bit(kTransferWrite);
constexpr AccessSet kTestAccess = access_bit(kDepthStencilRead) | access_bit(kDepthStencilWrite);
// Every graphics stage up to and including `last`: they are numbered in logical order.
constexpr StageSet graphics_until(uint32_t last) { return (1u << (last + 1)) - 1; }

constexpr std::array<StageRow, kStageCount> kStageRows = {{
    {"draw_indirect", stage::draw_indirect, graphics_until(kDrawIndirect), access_bit(kIndirectRead)},
    {"index_input", stage::index_input, graphics_until(kIndexInput), access_bit(kIndexRead)},
    {"vertex_attribute_input", stage::vertex_attribute_input, graphics_until(kVertexAttributeInput), access_bit(kVertexAttributeRead)},
    {"vertex_shader", stage::vertex_shader, graphics_until(kVertexShader), kShaderAccess},
    {"tess_control_shader", stage::tess_control_shader, graphics_until(kTessControlShader), kShaderAccess},
    {"tess_eval_shader", stage::tess_eval_shader, graphics_until(kTessEvalShader), kShaderAccess},
    {"geometry_shader", stage::geometry_shader, graphics_until(kGeometryShader), kShaderAccess},
    {"early_fragment_tests", stage::early_fragment_tests, graphics_until(kEarlyTests), kTestAccess},
    {"fragment_shader", stage::fragment_shader, graphics_until(kFragmentShader), kShaderAccess | access_bit(kInputAttachmentRead)},
    {"late_fragment_tests", stage::late_fragment_tests, graphics_until(kLateTests), kTestAccess},
    {"color_attachment_output", stage::color_attachment_output, graphics_until(kColorOutput), access_bit(kColorRead) | access_bit(kColorWrite)},
    {"compute_shader", stage::compute_shader, stage_bit(kDrawIndirect) | stage_bit(kComputeShader), kShaderAccess},
    {"copy", stage::copy, stage_bit(kCopy), kTransferAccess},
    {"resolve", stage::resolve, stage_bit(kResolve), kTransferAccess},
    {"blit", stage::blit, stage_bit(kBlit), kTransferAccess},
    {"clear", stage::clear, stage_bit(kClear), access_bit(kTransferWrite)},
    {"host", stage::host, stage_bit(kHost), access_bit(kHostRead) | access_bit(kHostWrite)},
}};

constexpr std::array<StageSet, kStageCount> make_later() {
  std::array<StageSet, kStageCount> later{};
  for (uint32_t s = 0; s < kStageCount; ++s)
    for (uint32_t t = 0; t < kStageCount; ++t)
      if (kStageRows[t].earlier & stage_bit(s)) later[s] |= stage_bit(t);
  return later;
}
constexpr std::array<StageSet, kStageCount> kLater = make_later();

struct AccessRow {
  const char* name;
  Accesses raw;
};
constexpr std::array<AccessRow, kAccessCount> kAccessRows = {{
    {"indirect_command_read", access::indirect_command_read},
    {"index_read", access::index_read},
    {"vertex_attribute_read", access::vertex_attribute_read},
    {"uniform_read", access::uniform_read},
    {"input_attachment_read", access::input_attachment_read},
    {"shader_sampled_read", access::shader_sampled_read},
    {"shader_storage_read", access::shader_storage_read},
    {"color_attachment_read", access::color_attachment_read},
    {"depth_stencil_attachment_read", access::depth_stencil_attachment_read},
    {"transfer_read", access::transfer_read},
    {"host_read", access::host_read},
    {"shader_storage_write", access::shader_storage_write},
    {"color_attachment_write", access::color_attachment_write},
    {"depth_stencil_attachment_write", access::depth_stencil_attachment_write},
    {"transfer_write", access::transfer_write},
    {"host_write", access::host_write},
}};

// Masks that stand for several stages or accesses.
struct StageAlias {
  Stages raw;
  StageSet meaning;
};
constexpr StageSet kTransferStages = stage_bit(kCopy) | stage_bit(kResolve) | stage_bit(kBlit) | stage_bit(kClear);
constexpr StageAlias kStageAliases[] = {{stage::all_transfer, kTransferStages},
                                        {stage::all_graphics, graphics_until(kColorOutput)},
                                        {stage::all_commands, kAllStages & ~stage_bit(kHost)}};
struct AccessAlias {
  Accesses raw;
  AccessSet meaning;
};
constexpr AccessAlias kAccessAliases[] = {{access::shader_read, access_bit(kSampledRead) | access_bit(kStorageRead)},
                                          {access::shader_write, access_bit(kStorageWrite)},
                                          {access::memory_read, kAllReads},
                                          {access::memory_write, kAllWrites}};

constexpr uint32_t kUsageTransferSrc = 1, kUsageTransferDst = 2, kUsageSampled = 4, kUsageColor = 16, kUsageDepthStencil = 32, kUsageInput = 128;

uint32_t bit_number(uint64_t bit) { return static_cast<uint32_t>(std::countr_zero(bit)); }

}  // namespace

StageSet expand_stages(Stages raw) {
  StageSet set = 0;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (raw & kStageRows[s].raw) set |= stage_bit(s);
  for (const StageAlias& alias : kStageAliases)
    if (raw & alias.raw) set |= alias.meaning;
  return set;
}

AccessSet expand_accesses(Accesses raw) {
  AccessSet set = 0;
  for (uint32_t a = 0; a < kAccessCount; ++a)
    if (raw & kAccessRows[a].raw) set |= access_bit(a);
  for (const AccessAlias& alias : kAccessAliases)
    if (raw & alias.raw) set |= alias.meaning;
  return set;
}

Stages unknown_stages(Stages raw) {
  for (const StageRow& row : kStageRows) raw &= ~row.raw;
  for (const StageAlias& alias : kStageAliases) raw &= ~alias.raw;
  return raw;
}

Accesses unknown_accesses(Accesses raw) {
  for (const AccessRow& row : kAccessRows) raw &= ~row.raw;
  for (const AccessAlias& alias : kAccessAliases) raw &= ~alias.raw;
  return raw;
}

uint32_t raw_bit_of_stage(Stages raw, uint32_t stage) {
  uint64_t bits = raw & kStageRows[stage].raw;
  for (const StageAlias& alias : kStageAliases)
    if (alias.meaning & stage_bit(stage)) bits |= raw & alias.raw;
  return std::has_single_bit(bits) ? bit_number(bits) : kNone;
}

uint32_t raw_bit_of_access(Accesses raw, uint32_t access) {
  uint64_t bits = raw & kAccessRows[access].raw;
  for (const AccessAlias& alias : kAccessAliases)
    if (alias.meaning & access_bit(access)) bits |= raw & alias.raw;
  return std::has_single_bit(bits) ? bit_number(bits) : kNone;
}

StageSet with_earlier(StageSet stages) {
  StageSet set = 0;
  for (StageSet rest = stages; rest != 0; rest &= rest - 1) set |= kStageRows[static_cast<size_t>(std::countr_zero(rest))].earlier;
  return set;
}

StageSet with_later(StageSet stages) {
  StageSet set = 0;
  for (StageSet rest = stages; rest != 0; rest &= rest - 1) set |= kLater[static_cast<size_t>(std::countr_zero(rest))];
  return set;
}

AccessSet supported(uint32_t stage) { return kStageRows[stage].accesses; }

AccessSet supported_by_any(StageSet stages) {
  AccessSet set = 0;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (stages & stage_bit(s)) set |= kStageRows[s].accesses;
  return set;
}

Layout layout_of_aspect(Layout layout, uint32_t aspect) {
  const bool depth = aspect == aspect_depth, stencil = aspect == aspect_stencil;
  if (!depth && !stencil) return layout;
  const Layout attachment = depth ? Layout::depth_attachment : Layout::stencil_attachment;
  const Layout read_only = depth ? Layout::depth_read_only : Layout::stencil_read_only;
  switch (layout) {
    case Layout::depth_stencil_attachment:
      return attachment;
    case Layout::depth_stencil_read_only:
      return read_only;
    case Layout::depth_read_only_stencil_attachment:
      return depth ? read_only : attachment;
    case Layout::depth_attachment_stencil_read_only:
      return depth ? attachment : read_only;
    default:
      return layout;
  }
}

uint32_t usage_for(Layout layout) {
  switch (layout) {
    case Layout::color_attachment:
      return kUsageColor;
    case Layout::depth_stencil_attachment:
    case Layout::depth_read_only_stencil_attachment:
    case Layout::depth_attachment_stencil_read_only:
    case Layout::depth_attachment:
    case Layout::stencil_attachment:
      return kUsageDepthStencil;
    case Layout::depth_stencil_read_only:
    case Layout::depth_read_only:
    case Layout::stencil_read_only:
      return kUsageDepthStencil | kUsageSampled | kUsageInput;
    case Layout::shader_read_only:
      return kUsageSampled | kUsageInput;
    case Layout::transfer_src:
      return kUsageTransferSrc;
    case Layout::transfer_dst:
      return kUsageTransferDst;
    default:
      return 0;
  }
}

std::string stage_name(uint32_t stage) { return stage < kStageCount ? kStageRows[stage].name : "none"; }
std::string access_name(uint32_t access) { return access < kAccessCount ? kAccessRows[access].name : "none"; }

std::string layout_name(Layout layout) {
  switch (layout) {
    case Layout::undefined:
      return "undefined";
    case Layout::general:
      return "general";
    case Layout::color_attachment:
      return "color_attachment";
    case Layout::depth_stencil_attachment:
      return "depth_stencil_attachment";
    case Layout::depth_stencil_read_only:
      return "depth_stencil_read_only";
    case Layout::shader_read_only:
      return "shader_read_only";
    case Layout::transfer_src:
      return "transfer_src";
    case Layout::transfer_dst:
      return "transfer_dst";
    case Layout::depth_read_only_stencil_attachment:
      return "depth_read_only_stencil_attachment";
    case Layout::depth_attachment_stencil_read_only:
      return "depth_attachment_stencil_read_only";
    case Layout::depth_attachment:
      return "depth_attachment";
    case Layout::depth_read_only:
      return "depth_read_only";
    case Layout::stencil_attachment:
      return "stencil_attachment";
    case Layout::stencil_read_only:
      return "stencil_read_only";
    case Layout::present_src:
      return "present_src";
  }
  return "layout " + std::to_string(static_cast<uint32_t>(layout));
}

std::string stages_text(StageSet stages) {
  std::string text;
  for (uint32_t s = 0; s < kStageCount; ++s)
    if (stages & stage_bit(s)) text += (text.empty() ? "" : "|") + stage_name(s);
  return text.empty() ? "none" : text;
}

}  // namespace rg::verify
