#include "tests/unit/plan/planned.h"

#include "dsl/front_end.h"

namespace rg::compiler {
namespace {

struct Name {
  uint64_t bit;
  const char* text;
};
constexpr Name kStages[] = {
    {stage::draw_indirect, "draw_indirect"},
    {stage::vertex_shader, "vertex_shader"},
    {stage::fragment_shader, "fragment_shader"},
    {stage::early_fragment_tests, "early_fragment_tests"},
    {stage::late_fragment_tests, "late_fragment_tests"},
    {stage::color_attachment_output, "color_attachment_output"},
    {stage::compute_shader, "compute_shader"},
    {stage::host, "host"},
    {stage::copy, "copy"},
    {stage::clear, "clear"},
    {stage::blit, "blit"},
};
constexpr Name kAccesses[] = {
    {access::indirect_command_read, "indirect_command_read"},
    {access::uniform_read, "uniform_read"},
    {access::color_attachment_read, "color_attachment_read"},
    {access::color_attachment_write, "color_attachment_write"},
    {access::depth_stencil_attachment_read, "depth_stencil_attachment_read"},
    {access::depth_stencil_attachment_write, "depth_stencil_attachment_write"},
    {access::transfer_read, "transfer_read"},
    {access::transfer_write, "transfer_write"},
    {access::host_read, "host_read"},
    {access::shader_sampled_read, "shader_sampled_read"},
    {access::shader_storage_read, "shader_storage_read"},
    {access::shader_storage_write, "shader_storage_write"},
};

template <size_t N>
std::string names(const Name (&table)[N], uint64_t bits) {
  std::string text;
  for (const Name& name : table)
    if (bits & name.bit) text += (text.empty() ? "" : "|") + std::string(name.text), bits &= ~name.bit;
  EXPECT_EQ(bits, 0u) << "a bit the tests have no name for";
  return text.empty() ? "none" : text;
}

std::string layout_name(Layout layout) {
  switch (layout) {
    case Layout::undefined:
      return "undefined";
    case Layout::general:
      return "general";
    case Layout::color_attachment:
      return "color_attachment";
    case Layout::shader_read_only:
      return "shader_read_only";
    case Layout::transfer_src:
      return "transfer_src";
    case Layout::transfer_dst:
      return "transfer_dst";
    case Layout::depth_attachment:
      return "depth_attachment";
    case Layout::depth_read_only:
      return "depth_read_only";
    case Layout::stencil_attachment:
      return "stencil_attachment";
    case Layout::present_src:
      return "present_src";
    default:
      return "layout " + std::to_string(static_cast<uint32_t>(layout));
  }
}

template <class Barrier>
std::string scopes(const Barrier& b) {
  return names(kStages, b.src_stages) + "/" + names(kAccesses, b.src_accesses) + " -> " + names(kStages, b.dst_stages) + "/" +
         names(kAccesses, b.dst_accesses);
}

std::string name_of(const PlanData& plan, const Ref& ref) {
  return std::string(plan.resources[ref.resource].name) + (ref.age ? ".prev(" + std::to_string(ref.age) + ")" : "");
}

std::string range_text(const Range& range) {
  std::string text;
  if (range.mip != 0 || range.mips != kRemaining)
    text += " mip " + std::to_string(range.mip) + "+" + (range.mips == kRemaining ? "" : std::to_string(range.mips));
  if (range.layer != 0 || range.layers != kRemaining)
    text += " layer " + std::to_string(range.layer) + "+" + (range.layers == kRemaining ? "" : std::to_string(range.layers));
  return text;
}

std::string bytes_text(const PlanData& plan, const Bytes& bytes) {
  if (bytes.offset == kNone && bytes.size == kNone) return "";
  const std::string offset = bytes.offset == kNone ? "0" : std::to_string(evaluate(plan.exprs, bytes.offset, {}));
  return " bytes " + offset + "+" + (bytes.size == kNone ? "" : std::to_string(evaluate(plan.exprs, bytes.size, {})));
}

std::string group_text(const PlanData& plan, const BarrierGroup& group, const std::string& resource) {
  std::string text;
  for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) {
    const ImageBarrier& b = plan.image_barriers[i];
    if (!resource.empty() && plan.resources[b.image.resource].name != resource) continue;
    text += name_of(plan, b.image) + (b.range.aspects == aspect_stencil ? " stencil" : "") + range_text(b.range) + " " + scopes(b) + "  " +
            layout_name(b.old_layout) + " -> " + layout_name(b.new_layout) + "\n";
  }
  for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i) {
    const BufferBarrier& b = plan.buffer_barriers[i];
    if (!resource.empty() && plan.resources[b.buffer.resource].name != resource) continue;
    text += name_of(plan, b.buffer) + bytes_text(plan, b.bytes) + " " + scopes(b) + "\n";
  }
  return text;
}

}  // namespace

dsl::Program program_of_text(const std::string& text) {
  dsl::Diagnostics diagnostics;
  const auto read = [&](const std::string&, std::string&) { return std::optional<std::string>(text); };
  dsl::FrontEndResult result = dsl::load_program("test.rg", read, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.files, false);
  return std::move(result.program);
}

dsl::Program program_of(const std::string& body) {
  return program_of_text(
      "module test\nextent view = runtime(64, 64) max(128, 128)\ncondition sometimes\n"
      "graph frame(surface backbuffer: rgba8 view after copy_src) {\n" +
      body + "}\n");
}

FramePlan plan_of(const dsl::Program& program, const PlanOptions& options) { return plan_frame(program, dsl::GraphId{size_t{0}}, {}, options); }
FramePlan plan_of(const std::string& body, const PlanOptions& options) { return plan_of(program_of(body), options); }

std::string schedule_text(const PlanData& plan, const std::string& resource) {
  std::string text;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass)
      text += "[" + std::string(plan.passes[step.index].name) + "]\n";
    else if (const BarrierGroup& group = plan.groups[step.index]; group.image_count + group.buffer_count > 0)
      text += group_text(plan, group, resource);
  }
  return text;
}

std::string order_text(const PlanData& plan) {
  std::string text;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass)
      text += std::string(plan.passes[step.index].name) + " ";
    else if (const BarrierGroup& group = plan.groups[step.index]; group.image_count + group.buffer_count > 0)
      text += "| ";
  }
  return text;
}

const Pass& pass_named(const PlanData& plan, const std::string& name) {
  for (const Pass& pass : plan.passes)
    if (pass.name == name) return pass;
  ADD_FAILURE() << "no pass `" << name << "`";
  static const Pass none;
  return none;
}

Index resource_named(const PlanData& plan, const std::string& name) {
  for (Index i = 0; i < plan.resources.size(); ++i)
    if (plan.resources[i].name == name) return i;
  ADD_FAILURE() << "no resource `" << name << "`";
  return kNone;
}

const Attachment& attachment_of(const PlanData& plan, const std::string& pass, const std::string& resource) {
  const Rendering& rendering = plan.renderings[pass_named(plan, pass).rendering];
  const Index wanted = resource_named(plan, resource);
  for (Index i = rendering.first_color; i < plan.attachments.size(); ++i)
    if (plan.attachments[i].ref.resource == wanted) return plan.attachments[i];
  ADD_FAILURE() << "`" << pass << "` has no attachment `" << resource << "`";
  static const Attachment none;
  return none;
}

}  // namespace rg::compiler
