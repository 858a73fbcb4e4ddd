#include "compiler/codegen/plan_values.h"

#include <filesystem>
#include <utility>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

template <class Bits>
using NamedBits = std::vector<std::pair<Bits, const char*>>;

#define RG_BIT(name) \
  { stage::name, "stage::" #name }
const NamedBits<Stages>& stage_bits() {
  static const NamedBits<Stages> bits = {RG_BIT(draw_indirect),
                                         RG_BIT(index_input),
                                         RG_BIT(vertex_attribute_input),
                                         RG_BIT(vertex_shader),
                                         RG_BIT(tess_control_shader),
                                         RG_BIT(tess_eval_shader),
                                         RG_BIT(geometry_shader),
                                         RG_BIT(early_fragment_tests),
                                         RG_BIT(fragment_shader),
                                         RG_BIT(late_fragment_tests),
                                         RG_BIT(color_attachment_output),
                                         RG_BIT(compute_shader),
                                         RG_BIT(all_transfer),
                                         RG_BIT(copy),
                                         RG_BIT(resolve),
                                         RG_BIT(blit),
                                         RG_BIT(clear),
                                         RG_BIT(bottom_of_pipe),
                                         RG_BIT(host),
                                         RG_BIT(all_graphics),
                                         RG_BIT(all_commands)};
  return bits;
}
#undef RG_BIT

#define RG_BIT(name) \
  { access::name, "access::" #name }
const NamedBits<Accesses>& access_bits() {
  static const NamedBits<Accesses> bits = {RG_BIT(indirect_command_read),
                                           RG_BIT(index_read),
                                           RG_BIT(vertex_attribute_read),
                                           RG_BIT(uniform_read),
                                           RG_BIT(input_attachment_read),
                                           RG_BIT(shader_read),
                                           RG_BIT(shader_write),
                                           RG_BIT(shader_sampled_read),
                                           RG_BIT(shader_storage_read),
                                           RG_BIT(shader_storage_write),
                                           RG_BIT(color_attachment_read),
                                           RG_BIT(color_attachment_write),
                                           RG_BIT(depth_stencil_attachment_read),
                                           RG_BIT(depth_stencil_attachment_write),
                                           RG_BIT(transfer_read),
                                           RG_BIT(transfer_write),
                                           RG_BIT(host_read),
                                           RG_BIT(host_write),
                                           RG_BIT(memory_read),
                                           RG_BIT(memory_write)};
  return bits;
}
#undef RG_BIT

template <class Bits>
std::string bits_text(Bits bits, const NamedBits<Bits>& names) {
  std::string text;
  for (const auto& [bit, name] : names) {
    if ((bits & bit) == 0) continue;
    text += (text.empty() ? "" : " | ") + std::string(name);
    bits &= ~bit;
  }
  RG_CHECK(bits == 0, "a mask of the plan has a bit without a name");
  return text.empty() ? "0" : text;
}

}  // namespace

std::string stages_text(Stages stages) { return bits_text(stages, stage_bits()); }
std::string accesses_text(Accesses accesses) { return bits_text(accesses, access_bits()); }

std::string aspects_text(uint32_t aspects) {
  static const NamedBits<uint32_t> names = {{aspect_color, "aspect_color"}, {aspect_depth, "aspect_depth"}, {aspect_stencil, "aspect_stencil"}};
  return bits_text(aspects, names);
}

std::string shader_stages_text(uint32_t stages) {
  static const NamedBits<uint32_t> names = {{1, "VK_SHADER_STAGE_VERTEX_BIT"},
                                            {2, "VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT"},
                                            {4, "VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT"},
                                            {8, "VK_SHADER_STAGE_GEOMETRY_BIT"},
                                            {16, "VK_SHADER_STAGE_FRAGMENT_BIT"},
                                            {32, "VK_SHADER_STAGE_COMPUTE_BIT"}};
  return bits_text(stages, names);
}

std::string layout_text(Layout layout) {
  switch (layout) {
    case Layout::undefined:
      return "Layout::undefined";
    case Layout::general:
      return "Layout::general";
    case Layout::color_attachment:
      return "Layout::color_attachment";
    case Layout::depth_stencil_attachment:
      return "Layout::depth_stencil_attachment";
    case Layout::depth_stencil_read_only:
      return "Layout::depth_stencil_read_only";
    case Layout::shader_read_only:
      return "Layout::shader_read_only";
    case Layout::transfer_src:
      return "Layout::transfer_src";
    case Layout::transfer_dst:
      return "Layout::transfer_dst";
    case Layout::depth_read_only_stencil_attachment:
      return "Layout::depth_read_only_stencil_attachment";
    case Layout::depth_attachment_stencil_read_only:
      return "Layout::depth_attachment_stencil_read_only";
    case Layout::depth_attachment:
      return "Layout::depth_attachment";
    case Layout::depth_read_only:
      return "Layout::depth_read_only";
    case Layout::stencil_attachment:
      return "Layout::stencil_attachment";
    case Layout::stencil_read_only:
      return "Layout::stencil_read_only";
    case Layout::present_src:
      return "Layout::present_src";
  }
  RG_CHECK(false, "a layout of the plan has no name");
  return "";
}

PlanNames plan_names(const Plan& plan) {
  PlanNames names;
  for (const Pass& pass : plan.passes) names.passes.push_back(cpp_name(pass.name));
  for (const Resource& resource : plan.resources) names.resources.push_back(cpp_name(resource.name));
  return {distinct(std::move(names.passes)), distinct(std::move(names.resources))};
}

std::string shown_path(const dsl::SourceFiles& files, std::string_view path) {
  namespace fs = std::filesystem;
  if (files.empty()) return std::string(path);
  const fs::path root = fs::path(files.rows[0].path).parent_path();
  const fs::path below = root.empty() ? fs::path(path) : fs::path(path).lexically_relative(root);
  return below.empty() || *below.begin() == ".." ? std::string(path) : below.generic_string();
}

std::string origin(const dsl::SourceFiles& files, dsl::Span span) {
  if (!span.file.valid() || span.file.value >= files.size()) return "";
  const dsl::SourceFile& source = files[span.file];
  return shown_path(files, source.path) + ":" + std::to_string(source.position(span.begin).line);
}

}  // namespace rg::compiler
