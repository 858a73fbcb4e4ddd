// The typed API of one graph as C++ text.
#include <algorithm>

#include "compiler/codegen/frame_api.h"
#include "compiler/plan_figures.h"

namespace rg::compiler {
namespace {

std::string behind(const std::string& comment) { return comment.empty() ? "" : "  // " + comment; }

void member_struct(CppWriter& out, const char* name, const char* what, const std::vector<ApiMember>& members, const char* initial) {
  if (members.empty()) return;
  out.line(std::string("// ") + what);
  out.line(std::string("struct ") + name + " {");
  for (const ApiMember& member : members) {
    const char* value = member.type.starts_with(kUnusedImport) ? " = {}" : initial;  // an engine that leaves it out is not warned
    out.line("  " + member.type + " " + member.name + value + ";" + behind(member.comment));
  }
  out.line("};").line();
}

void features(CppWriter& out, const std::vector<ApiFeature>& list) {
  for (const ApiFeature& feature : list) {
    if (feature.values.empty()) continue;
    std::string values;
    for (const std::string& value : feature.values) values += (values.empty() ? "" : ", ") + value;
    out.line("enum class " + feature.type + " : uint32_t { " + values + " };");
  }
  if (list.empty()) return;
  out.line("// Which variants of shaders this frame runs, and which passes.");
  out.line("struct Features {");
  for (const ApiFeature& feature : list) {
    const std::string initial = feature.values.empty() ? (feature.initial ? "true" : "false") : feature.type + "::" + feature.values[feature.initial];
    out.line("  " + feature.type + " " + feature.name + " = " + initial + ";" + behind(feature.comment));
  }
  out.line("};").line();
}

std::string size_initial(const ApiExtent& extent) {
  std::string text = "{";
  for (uint32_t axis = 0; axis < extent.axes; ++axis) text += (axis > 0 ? ", " : "") + std::to_string(extent.initial[axis]);
  return text + "}";
}

void extents(CppWriter& out, const FrameApi& api) {
  out.line("// Chosen at creation and by resize.");
  out.line("struct Extents {");
  for (const ApiExtent& extent : api.extents)
    out.line("  rg::Size" + std::to_string(extent.axes) + " " + extent.name + " = " + size_initial(extent) + ";");
  out.line("};").line();
}

void indices(CppWriter& out, const char* scope, const char* what, const std::vector<std::string>& names) {
  out.line(std::string("// ") + what);
  out.line(std::string("namespace ") + scope + " {");
  for (size_t i = 0; i < names.size(); ++i) out.line("inline constexpr rg::Index " + names[i] + " = " + std::to_string(i) + ";");
  out.line(std::string("}  // namespace ") + scope).line();
}

void figures(CppWriter& out, const FramePlan& frame) {
  const PlanData& plan = frame.plan;
  Row row;
  row.number("passes", plan.passes.size()).number("culled", plan.culled.size()).number("shaders", plan.shaders.size());
  row.number("pipelines", plan.pipelines.size()).number("barrier_groups", plan.groups.size()).number("memory_barriers", plan.memory_barriers.size());
  row.number("image_barriers", plan.image_barriers.size()).number("buffer_barriers", plan.buffer_barriers.size());
  row.number("batches", plan.batches.size()).number("waits", plan.waits.size()).number("heap_bytes", frame.heap_bytes);
  row.number("unaliased_bytes", frame.unaliased_bytes).number("lower_bound_bytes", frame.lower_bound_bytes);
  std::string text = row.lines(4);
  text.replace(text.rfind(','), 1, ";");
  out.line("// Of the plan at its initial extents; static_assert your budgets on them.");
  out.line("inline constexpr rg::Figures kFigures =");
  out.line(text);
}

Row pass_row(const PassFigures& pass) {
  Row row;
  row.number("position", pass.position).number("group", pass.group).number("batch", pass.batch).number("queue", pass.queue);
  return row.number("barriers", pass.barriers).number("before", pass.before);
}

Row resource_row(const ResourceFigures& resource) {
  Row row;
  row.number("bytes", resource.bytes).number("offset", resource.offset).flag("transient", resource.transient);
  if (resource.first != kNone) row.number("first", resource.first).number("last", resource.last);
  return row;
}

Row shader_row(const ShaderStatistics& s) {
  Row row;
  row.number("instructions", s.instructions).number("alu", s.alu).number("samples", s.samples).number("loads", s.loads).number("stores", s.stores);
  return row.number("atomics", s.atomics)
      .number("branches", s.branches)
      .number("shared_bytes", s.shared_bytes)
      .number("live_scalars", s.live_scalars);
}

std::string without_break(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

void figure_table(CppWriter& out, const char* type, const char* name, std::vector<Row> rows, const std::vector<std::string>& names) {
  if (rows.empty()) return;
  out.line(std::string("inline constexpr ") + type + " " + name + "[] = {");
  for (size_t i = 0; i < rows.size(); ++i) out.line(without_break(rows[i].comment(names[i]).lines(4)));
  out.line("};");
}

// The facts that assertions judge, pass by pass and resource by resource.
void figure_tables(CppWriter& out, const FrameApi& api, const FramePlan& frame) {
  const PlanFigures figures = find_figures(frame.plan);
  std::vector<Row> passes, resources, shaders;
  for (const PassFigures& pass : figures.passes) passes.push_back(pass_row(pass));
  for (const ResourceFigures& resource : figures.resources) resources.push_back(resource_row(resource));
  if (!frame.plan.shaders.empty())
    for (const ShaderStatistics& pass : find_shader_figures(frame.plan)) shaders.push_back(shader_row(pass));
  out.line("// By index of Plan::passes and Plan::resources; rg::overlap, rg::runs_before, rg::share_bytes and rg::lifetime read them.");
  figure_table(out, "rg::PassFigures", "kPassFigures", std::move(passes), api.names.passes);
  figure_table(out, "rg::ShaderFigures", "kShaderFigures", std::move(shaders), api.names.passes);
  figure_table(out, "rg::ResourceFigures", "kResourceFigures", std::move(resources), api.names.resources);
}

// ---- passes the host records

void pass_struct(CppWriter& out, const ApiPass& pass) {
  const char* base = pass.raster ? "rg::RasterRecording" : pass.compute ? "rg::ComputeRecording" : "rg::Recording";
  out.line("struct " + pass.type + " : " + base + " {" + behind(pass.comment));
  if (!pass.push_type.empty())
    out.line("  void push(const " + pass.push_type + "& per_draw) const { rg::push_constants(*this, " + shader_stages_text(pass.push_stages) +
             ", per_draw); }");
  out.line("};");
}

void recorder(CppWriter& out, const FrameApi& api) {
  if (api.passes.empty()) return;
  out.line("// ---- passes the host records: what a recorder's methods are given");
  out.line();
  for (const ApiPass& pass : api.passes) pass_struct(out, pass);
  out.line();
  out.line("// One method a pass. Leave one out, and execute() does not compile.");
  out.line("template <class R>");
  out.line("concept " + api.class_name + "Recorder = requires(R& recorder) {");
  for (const ApiPass& pass : api.passes) out.line("  recorder." + pass.method + "(std::declval<" + pass.type + "&>());");
  out.line("};").line();
}

// ---- class Frame

struct Argument {
  std::string type, name;
};
// What one frame takes besides the recorder, in order. Only what the graph has.
std::vector<Argument> arguments(const FrameApi& api) {
  std::vector<Argument> list;
  if (!api.imports.empty()) list.push_back({"Imports", "imports"});
  if (!api.params.empty()) list.push_back({"Params", "params"});
  if (!api.engine_sets.empty()) list.push_back({"EngineSets", "engine_sets"});
  if (!api.updates.empty()) list.push_back({"Updates", "updates"});
  if (!api.conditions.empty()) list.push_back({"Conditions", "conditions"});
  if (!api.features.empty()) list.push_back({"Features", "features"});
  return list;
}

std::vector<std::string> parameters(const FrameApi& api, std::initializer_list<const char*> last) {
  std::vector<std::string> list;
  for (const Argument& argument : arguments(api)) list.push_back("const " + argument.type + "& " + argument.name);
  list.insert(list.end(), last.begin(), last.end());
  return list;
}

std::vector<std::string> argument_names(const FrameApi& api, std::initializer_list<const char*> last) {
  std::vector<std::string> list;
  for (const Argument& argument : arguments(api)) list.push_back(argument.name);
  list.insert(list.end(), last.begin(), last.end());
  return list;
}

void execute(CppWriter& out, const FrameApi& api) {
  out.line("  // Records and submits one frame. Allocates nothing.");
  if (api.passes.empty()) {
    out.call("  rg::Status execute", parameters(api, {}), " {");
    out.call("    return submit", argument_names(api, {"nullptr", "nullptr"}), ";");
    out.line("  }");
    return;
  }
  out.line("  template <" + api.class_name + "Recorder R>");
  out.call("  rg::Status execute", parameters(api, {"R& recorder"}), " {");
  out.line("    static constexpr rg::RecordFunction callbacks[] = {");
  for (const ApiPass& pass : api.passes)
    out.line("        record<R, " + pass.type + ", [](R& r, " + pass.type + "& pass) { r." + pass.method + "(pass); }>,");
  out.line("    };");
  out.call("    return submit", argument_names(api, {"callbacks", "&recorder"}), ";");
  out.line("  }");
}

void record_function(CppWriter& out) {
  out.line("  template <class R, class Pass, auto method>");
  out.line("  static void record(void* user, rg::Recording& recording) {");
  out.line("    Pass pass{{recording}};");
  out.line("    method(*static_cast<R*>(user), pass);");
  out.line("  }");
}

void frame_class(CppWriter& out, const FrameApi& api) {
  const std::string& name = api.class_name;
  out.line(
      "// The graph on a device: its memory, its objects and its frames. Moved, not copied; one thread at a time; the device outlives it. Errors are "
      "values and");
  out.line("// leave it as it was, but a lost device, which stays lost. Destruction waits for its frames and for nothing else.");
  out.line("class " + name + " : public rg::TypedFrame {");
  out.line(" public:");
  out.line("  static rg::Result<" + name + "> create(rg::Device& device, const Extents& extents, rg::GraphOptions options = {});");
  out.line("  // Goes on where `current` is, another configuration of this graph, at its extents; see GraphInstance::create_successor.");
  out.line("  static rg::Result<" + name + "> create_successor(rg::TypedFrame& current, const rg::GraphOptions& options = {});");
  out.line("  // What depends on extents is placed anew; on failure the old state stays.");
  out.line("  rg::Status resize(const Extents& extents);");
  out.line("  // Dynamic resolution: passes run over a part of what is placed; see GraphInstance::set_active.");
  out.line("  rg::Status set_active(const Extents& extents);");
  out.line();
  execute(out, api);
  out.line();
  for (const ApiReadback& readback : api.readbacks) {
    out.line("  // `" + readback.name + "` of the last finished frame; waits for it. Valid until the next execute." +
             (readback.comment.empty() ? "" : "  " + readback.comment));
    out.line("  rg::Result<std::span<const " + readback.element + ">> " + readback.name + "();");
  }
  if (!api.readbacks.empty()) out.line();
  out.line(" private:");
  if (!api.passes.empty()) record_function(out);
  out.call("  rg::Status submit", parameters(api, {"const rg::RecordFunction* callbacks", "void* recorder"}), ";");
  out.line("  using TypedFrame::TypedFrame;");
  out.line("};");
}

// ---- definitions

void extent_values(CppWriter& out, const FrameApi& api) {
  static constexpr const char* kAxes[] = {"width", "height", "depth"};
  out.line("namespace {");
  out.line("std::array<int64_t, " + std::to_string(3 * api.extents.size()) + "> extent_values([[maybe_unused]] const Extents& extents) {");
  std::string text;
  for (const ApiExtent& extent : api.extents)
    for (uint32_t axis = 0; axis < 3; ++axis)
      text += (text.empty() ? "" : ", ") + (axis < extent.axes ? "extents." + extent.name + "." + kAxes[axis] : std::string("1"));
  out.line("  return {" + text + "};");
  out.line("}");
  out.line("}  // namespace").line();
}

void create(CppWriter& out, const FrameApi& api) {
  const std::string& name = api.class_name;
  out.line("rg::Result<" + name + "> " + name + "::create(rg::Device& device, const Extents& extents, rg::GraphOptions options) {");
  out.line("  const auto values = extent_values(extents);");
  out.line("  options.extents = values;");
  out.line("  auto instance = rg::GraphInstance::create(device, plan(), options);");
  out.line("  if (!instance) return instance.error();");
  out.line("  return " + name + "(plan(), std::move(*instance), options);");
  out.line("}").line();
  out.line("rg::Result<" + name + "> " + name + "::create_successor(rg::TypedFrame& current, const rg::GraphOptions& options) {");
  out.line("  auto instance = succeed(current, plan(), options);");
  out.line("  if (!instance) return instance.error();");
  out.line("  return " + name + "(plan(), std::move(*instance), options);");
  out.line("}").line();
  out.line("rg::Status " + name + "::resize(const Extents& extents) { return resize_to(extent_values(extents)); }");
  out.line("rg::Status " + name + "::set_active(const Extents& extents) { return set_active_to(extent_values(extents)); }").line();
}

void import_rows(CppWriter& out, const FrameApi& api) {
  out.line("  const rg::Import import_rows[] = {");
  for (const ApiMember& member : api.imports) {
    const char* kind = member.type.find("Image") != std::string::npos ? "image" : "buffer";
    out.line(member.type.starts_with(kUnusedImport) ? "      {},  // " + member.name
                                                    : std::string("      {.") + kind + " = imports." + member.name + ".value},");
  }
  out.line("  };");
  const auto unused = [](const ApiMember& member) { return member.type.starts_with(kUnusedImport); };
  if (std::all_of(api.imports.begin(), api.imports.end(), unused)) out.line("  (void)imports;");
  out.line("  inputs.imports = import_rows;");
}

void rows(CppWriter& out, const std::string& type, const char* from, const char* name, const std::vector<ApiMember>& members, const char* before,
          const char* after) {
  out.line("  const " + type + " " + name + "_rows[] = {");
  for (const ApiMember& member : members) out.line(std::string("      ") + before + from + "." + member.name + after + ",");
  out.line("  };");
  out.line(std::string("  inputs.") + name + " = " + name + "_rows;");
}

void feature_rows(CppWriter& out, const std::vector<std::string>& values) {
  out.line("  const uint32_t feature_rows[] = {");
  for (const std::string& value : values) out.line("      " + value + ",");
  out.line("  };");
  out.line("  inputs.features = feature_rows;");
}

void submit(CppWriter& out, const FrameApi& api) {
  out.call("rg::Status " + api.class_name + "::submit", parameters(api, {"const rg::RecordFunction* callbacks", "void* recorder"}), " {");
  out.line("  rg::FrameInputs inputs;");
  out.line("  inputs.callbacks = callbacks;");
  out.line("  inputs.user = recorder;");
  if (!api.imports.empty()) import_rows(out, api);
  if (!api.params.empty()) rows(out, "std::span<const std::byte>", "params", "params", api.params, "rg::bytes_of(", ")");
  if (!api.engine_sets.empty()) rows(out, "VkDescriptorSet", "engine_sets", "engine_sets", api.engine_sets, "", ".value");
  if (!api.updates.empty()) rows(out, "std::span<const std::byte>", "updates", "updates", api.updates, "", "");
  if (!api.feature_values.empty()) feature_rows(out, api.feature_values);
  for (size_t i = 0; i < api.condition_bits.size(); ++i)
    if (!api.condition_bits[i].empty())
      out.line("  if (conditions." + api.condition_bits[i] + ") inputs.conditions |= uint64_t{1} << " + std::to_string(i) + ";");
  out.line("  return execute_inputs(inputs);");
  out.line("}");
}

void readbacks(CppWriter& out, const FrameApi& api) {
  for (const ApiReadback& readback : api.readbacks) {
    out.line();
    out.line("rg::Result<std::span<const " + readback.element + ">> " + api.class_name + "::" + readback.name + "() {");
    out.line("  const auto bytes = read_back(resource::" + readback.resource + ");");
    out.line("  if (!bytes) return bytes.error();");
    out.line("  return rg::elements_of<" + readback.element + ">(*bytes);");
    out.line("}");
  }
}

}  // namespace

std::string emit_declarations(const FrameApi& api, const FramePlan& plan) {
  CppWriter out;
  extents(out, api);
  member_struct(out, "Imports", "What the engine brings each frame, in the declared state.", api.imports, "");
  member_struct(out, "Params", "Parameter blocks, copied when the frame is recorded.", api.params, " = {}");
  member_struct(out, "EngineSets", "Descriptor sets the engine owns.", api.engine_sets, "");
  member_struct(out, "Updates", "Bytes that update statements copy.", api.updates, " = {}");
  member_struct(out, "Conditions", "Latched when the frame is recorded.", api.conditions, " = {}");
  features(out, api.features);
  recorder(out, api);
  out.line("// What the class below runs, as data: for tools, and for PlanFile and check_interface.");
  out.line("const rg::Plan& plan();").line();
  figures(out, plan);
  figure_tables(out, api, plan);
  indices(out, "pass", "Indices of Plan::passes.", api.names.passes);
  indices(out, "resource", "Indices of Plan::resources.", api.names.resources);
  frame_class(out, api);
  return out.text();
}

std::string emit_definitions(const FrameApi& api) {
  CppWriter out;
  out.line("const rg::Plan& plan() { return kPlan; }").line();
  extent_values(out, api);
  create(out, api);
  submit(out, api);
  readbacks(out, api);
  return out.text();
}

}  // namespace rg::compiler
