#include "compiler/codegen/frame_api.h"

#include <algorithm>
#include <set>

#include "compiler/slots.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

void name_members(std::vector<ApiMember>& members) {
  std::vector<std::string> names;
  for (const ApiMember& member : members) names.push_back(cpp_name(member.name));
  names = distinct(std::move(names));
  for (size_t i = 0; i < members.size(); ++i) members[i].name = names[i];
}

template <class Row>
void put(std::vector<Row>& rows, Index slot, Row row) {
  if (rows.size() <= slot) rows.resize(slot + 1);
  rows[slot] = std::move(row);
}

struct Source {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const PlanData& plan;
  const dsl::SourceFiles& files;
  const std::vector<StructUse>& uses;
  std::string where(dsl::Span span) const { return origin(files, span); }
  std::string where_pass(size_t plan_pass) const {
    return plan.program_pass[plan_pass] == kNone ? "" : where(graph.passes.rows[plan.program_pass[plan_pass]].span);
  }
};

// All that is declared, whatever this plan uses of it: a pass that comes or goes changes no code of the engine's.
std::vector<ApiMember> collect_imports(const Source& s) {
  std::vector<bool> used(s.graph.resources.size());
  for (const uint32_t r : s.plan.program_resource) used[r] = true;
  const std::vector<Index> slots = import_slots(s.graph);
  std::vector<ApiMember> imports;
  for (size_t r = 0; r < slots.size(); ++r) {
    if (slots[r] == kNone) continue;
    const dsl::Resource& resource = s.graph.resources.rows[r];
    const char* type = resource.kind == dsl::ResourceKind::image ? "rg::ImportedImage" : "rg::ImportedBuffer";
    put(imports, slots[r], {resource.name, std::string(used[r] ? "rg::Required<" : kUnusedImport) + type + ">", s.where(resource.span)});
  }
  name_members(imports);
  return imports;
}

std::vector<ApiMember> collect_params(const Source& s) {
  std::vector<ApiMember> params;
  for (const dsl::Params& block : s.graph.params) {
    const std::string owner = block.pass.valid() ? s.graph.passes[block.pass].name + "_" : "";
    params.push_back({owner + block.name, mirror_name(s.program, s.uses, block.type, true), s.where(block.span)});
  }
  name_members(params);
  return params;
}

// The program keeps the name of the host's bytes; plan and program list a pass's updates in the same order.
std::vector<ApiMember> collect_updates(const Source& s) {
  std::vector<ApiMember> updates;
  for (size_t p = 0; p < s.plan.passes.size(); ++p) {
    const Pass& pass = s.plan.passes[p];
    if (s.plan.program_pass[p] == kNone) continue;
    const dsl::Pass& source = s.graph.passes.rows[s.plan.program_pass[p]];
    std::vector<const dsl::Transfer*> written;
    for (const dsl::Transfer& transfer : source.transfers)
      if (transfer.kind == dsl::TransferKind::update) written.push_back(&transfer);
    size_t next = 0;
    for (Index t = pass.work.first_transfer; t < pass.work.first_transfer + pass.work.transfer_count; ++t) {
      const Transfer& transfer = s.plan.transfers[t];
      if (transfer.update_slot == kNone) continue;
      const std::string name = next < written.size() && !written[next]->data.empty() ? written[next]->data : source.name;
      ++next;
      put(updates, transfer.update_slot, {name, "std::span<const std::byte>", s.where(source.span)});
    }
  }
  name_members(updates);
  return updates;
}

std::vector<ApiPass> collect_passes(const Source& s, const PlanNames& names) {
  std::vector<ApiPass> passes;
  for (size_t p = 0; p < s.plan.passes.size(); ++p) {
    const Pass& pass = s.plan.passes[p];
    if (pass.host_slot == kNone) continue;
    ApiPass row;
    row.method = names.passes[p];
    row.type = cpp_type_name(names.passes[p]) + "Pass";
    row.comment = s.where_pass(p);
    row.raster = pass.kind == PassKind::raster;
    row.compute = pass.kind == PassKind::compute;
    row.push_stages = pass.push_stages;
    if (pass.push_bytes > 0 && s.plan.program_pass[p] != kNone) {
      const dsl::Pass& source = s.graph.passes.rows[s.plan.program_pass[p]];
      row.push_type = mirror_name(s.program, s.uses, source.draw.per_draw, false);
    }
    put(passes, pass.host_slot, std::move(row));
  }
  return passes;
}

// `bool fog = true`, or `Shading shading = Shading::tiled` with an enum of its own.
void collect_features(const Source& s, FrameApi& api) {
  std::vector<std::string> names;
  for (const Feature& feature : s.plan.features) names.push_back(cpp_name(feature.name));
  names = distinct(std::move(names));
  for (size_t i = 0; i < names.size(); ++i) {
    if (s.plan.features[i].capability != Capability::none) {
      api.feature_values.emplace_back("0 /* " + names[i] + ": the device knows */");
      continue;
    }
    const auto same = [&](const dsl::Feature& feature) { return feature.name == s.plan.features[i].name; };
    const dsl::Feature& source = *std::find_if(s.program.features.begin(), s.program.features.end(), same);
    const bool is_bool = source.values == std::vector<std::string>{"off", "on"};
    ApiFeature row{names[i], is_bool ? "bool" : cpp_type_name(names[i]), {}, source.initial, s.where(source.span)};
    if (!is_bool)
      for (const std::string& value : source.values) row.values.push_back(cpp_name(value));
    row.values = distinct(std::move(row.values));
    api.feature_values.push_back("static_cast<uint32_t>(features." + row.name + ")");
    api.features.push_back(std::move(row));
  }
}

std::vector<ApiReadback> collect_readbacks(const Source& s, const PlanNames& names) {
  std::vector<ApiReadback> readbacks;
  for (size_t r = 0; r < s.plan.resources.size(); ++r) {
    if (s.plan.resources[r].lifetime != Lifetime::readback) continue;
    const dsl::Resource& source = s.graph.resources.rows[s.plan.program_resource[r]];
    // Of the class and of rg::TypedFrame.
    static const std::set<std::string> kMethods = {
        "built_",        "continue_from", "create",        "create_successor", "execute",      "execute_inputs",  "frame",          "gone",
        "history_valid", "instance",      "invalidate",    "memory",           "pass_info",    "pass_statistics", "pass_times",     "profile_json",
        "read_back",     "reconfigure",   "record",        "reload",           "request_dump", "resize",          "resize_to",      "running_plan",
        "set_active",    "succeed",       "set_active_to", "submit",           "take_dump",    "use_commands",    "use_semaphores", "wait_idle"};
    const std::string method = names.resources[r] + (kMethods.contains(names.resources[r]) ? "_" : "");
    readbacks.push_back({method, names.resources[r], mirror_type(s.program, s.uses, source.element, false), s.where(source.span)});
  }
  return readbacks;
}

// An array of conditions is one member.
void collect_conditions(const dsl::Program& program, FrameApi& api) {
  std::vector<size_t> member_of;
  for (const dsl::Condition& condition : program.conditions) {
    if (condition.feature.valid()) {
      member_of.push_back(SIZE_MAX);
      continue;
    }
    const bool goes_on = condition.count > 0 && condition.index > 0;
    if (!goes_on) api.conditions.push_back({condition.count > 0 ? condition.family : condition.name, "bool", ""});
    member_of.push_back(api.conditions.size() - 1);
  }
  name_members(api.conditions);
  for (size_t bit = 0; bit < member_of.size(); ++bit) {
    const dsl::Condition& condition = program.conditions.rows[bit];
    const std::string index = condition.count > 0 ? "[" + std::to_string(condition.index) + "]" : "";
    if (member_of[bit] == SIZE_MAX) {
      api.condition_bits.emplace_back();
      continue;
    }
    api.condition_bits.push_back(api.conditions[member_of[bit]].name + index);
  }
  for (size_t bit = 0; bit < member_of.size(); ++bit) {
    const dsl::Condition& condition = program.conditions.rows[bit];
    if (condition.count > 0 && condition.index == 0 && member_of[bit] != SIZE_MAX)
      api.conditions[member_of[bit]].name += "[" + std::to_string(condition.count) + "]";
  }
}

}  // namespace

FrameApi collect_api(const dsl::Program& program, dsl::GraphId graph_id, const FramePlan& frame, const dsl::SourceFiles& files) {
  const dsl::Graph& graph = program.graphs[graph_id];
  const std::vector<StructUse> uses = find_struct_uses(program);
  const Source source{program, graph, frame.plan, files, uses};
  FrameApi api;
  api.scope = cpp_name(program.module);
  if (program.graphs.size() > 1) api.scope += "::" + cpp_name(graph.name) + "_graph";
  if (frame.plan.variant_count > 1) api.scope += "::" + cpp_name(frame.plan.variant_name);
  api.class_name = cpp_type_name(graph.name);
  api.names = plan_names(frame.plan.view());
  for (const Extent& extent : frame.plan.extents)
    api.extents.push_back({cpp_name(extent.name), extent.axes, {extent.initial[0], extent.initial[1], extent.initial[2]}});
  api.imports = collect_imports(source);
  api.params = collect_params(source);
  api.updates = collect_updates(source);
  collect_conditions(program, api);
  for (const EngineSet& set : frame.plan.engine_sets) api.engine_sets.push_back({std::string(set.name), "rg::Required<VkDescriptorSet>", ""});
  name_members(api.engine_sets);
  collect_features(source, api);
  api.passes = collect_passes(source, api.names);
  api.readbacks = collect_readbacks(source, api.names);
  return api;
}

}  // namespace rg::compiler
