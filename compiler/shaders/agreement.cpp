#include "compiler/shaders/agreement.h"

#include <algorithm>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

struct Checker {
  const PassContext& context;
  const std::vector<StageOutput>& stages;
  ShaderPlaces& places;
  dsl::Diagnostics& diagnostics;
};

const ReflectedBinding* find_binding(const Reflection& reflection, const InterfaceBinding& binding) {
  for (const ReflectedBinding& found : reflection.bindings)
    if (found.set == 1 && found.binding == binding.binding && found.name == binding.name) return &found;
  return nullptr;
}

ModuleUse use_in(const StageOutput& stage, const InterfaceBinding& binding) {
  const auto found = stage.uses.descriptors.find({1, binding.binding});
  return found == stage.uses.descriptors.end() ? ModuleUse{} : found->second;
}

bool used_as_written(const StageOutput& stage, const InterfaceBinding& binding) {
  const ReflectedBinding* found = find_binding(stage.reflection, binding);
  return found != nullptr && found->statically_used;
}

void check_used(const Checker& c, const InterfaceBinding& binding) {
  const bool used = std::any_of(c.stages.begin(), c.stages.end(), [&](const StageOutput& stage) { return used_as_written(stage, binding); });
  if (used) return;
  const std::string& name = binding.access != dsl::kAll ? c.context.pass.accesses[binding.access].name : binding.name;
  auto& diagnostic = c.diagnostics.report(DiagnosticKind::UnusedAccess, binding.span, {name, c.context.pass.name});
  for (const StageOutput& stage : c.stages) diagnostic.note(DiagnosticKind::ShaderOfPass, stage.span, {c.context.pass.name});
}

void report_contradiction(const Checker& c, const StageOutput& stage, const dsl::Access& access, DiagnosticKind kind, const char* verb) {
  c.diagnostics.report(kind, c.places.word(stage.path, access.name), {access.name, c.context.pass.name, verb})
      .note(DiagnosticKind::AccessDeclaredHere, access.span, {access.name});
}

void check_mode(const Checker& c, const StageOutput& stage, const InterfaceBinding& binding, const dsl::Access& access) {
  const ModuleUse use = use_in(stage, binding);
  if (access.role != dsl::Role::storage) return;
  if (access.mode == dsl::Mode::read && (use.writes || use.atomics))
    report_contradiction(c, stage, access, DiagnosticKind::WriteThroughRead, "written");
  if (access.mode == dsl::Mode::write && (use.reads || use.atomics)) report_contradiction(c, stage, access, DiagnosticKind::ReadOfWriteOnly, "read");
  if (access.mode == dsl::Mode::atomic && (use.writes || use.reads))
    report_contradiction(c, stage, access, DiagnosticKind::PlainAccessOfAtomic, use.writes ? "written" : "read");
}

void check_update(const Checker& c, const InterfaceBinding& binding, const dsl::Access& access) {
  if (access.mode != dsl::Mode::update || access.role != dsl::Role::storage) return;
  const auto writes = [&](const StageOutput& stage) { return use_in(stage, binding).writes || use_in(stage, binding).atomics; };
  const auto reads = [&](const StageOutput& stage) { return use_in(stage, binding).reads; };
  if (std::any_of(c.stages.begin(), c.stages.end(), writes) || std::none_of(c.stages.begin(), c.stages.end(), reads)) return;
  c.diagnostics.report(DiagnosticKind::UpdateNeverWritten, access.span, {access.name, c.context.pass.name})
      .note(DiagnosticKind::AccessUsedHere, c.places.word(c.stages.front().path, access.name), {access.name});
}

std::string stage_list(uint32_t stages) {
  std::string list;
  for (uint32_t bit = 1; bit <= dsl::stage_compute; bit <<= 1) {
    if ((stages & bit) == 0) continue;
    list += (list.empty() ? "`" : ", `") + stage_name(static_cast<dsl::Stage>(bit)) + "`";
  }
  return list;
}

void check_declared_stages(const Checker& c, const StageOutput& stage, const InterfaceBinding& binding, const dsl::Access& access) {
  if (access.stages == 0 || (access.stages & stage.stage) != 0 || !use_in(stage, binding).touched) return;
  c.diagnostics
      .report(DiagnosticKind::StageNotDeclared, access.span, {access.name, c.context.pass.name, stage_name(stage.stage), stage_list(access.stages)})
      .note(DiagnosticKind::AccessUsedHere, c.places.word(stage.path, access.name), {access.name});
}

bool is_own_descriptor(const ReflectedBinding& found, const std::vector<InterfaceBinding>& bindings, const std::string& engine_set) {
  if (found.set != 1) return engine_set.find(found.name) == std::string::npos;
  return std::none_of(bindings.begin(), bindings.end(),
                      [&](const InterfaceBinding& b) { return b.binding == found.binding && b.name == found.name; });
}

void check_own_descriptors(const Checker& c, const StageOutput& stage, const std::vector<InterfaceBinding>& bindings) {
  const dsl::EngineSet* set = engine_set_of(c.context.program, c.context.pass);
  for (const ReflectedBinding& found : stage.reflection.bindings) {
    if (!is_own_descriptor(found, bindings, set != nullptr ? set->glsl : "")) continue;
    c.diagnostics
        .report(DiagnosticKind::OwnDescriptor, c.places.word(stage.path, found.name), {found.name, std::to_string(found.set), c.context.pass.name})
        .note(DiagnosticKind::DeclareAccess, c.context.pass.span, {"read RESOURCE as sampled"});
  }
}

const StageOutput* find_stage(const Checker& c, dsl::Stage stage) {
  for (const StageOutput& output : c.stages)
    if (output.stage == stage) return &output;
  return nullptr;
}

void check_outputs(const Checker& c) {
  const StageOutput* fragment = find_stage(c, dsl::stage_fragment);
  uint32_t location = 0;
  for (const dsl::Access& access : c.context.pass.accesses) {
    if (access.role != dsl::Role::color) continue;
    const uint32_t at = location++;
    if (fragment != nullptr && fragment->uses.outputs.contains(at) && fragment->uses.outputs.at(at).writes) continue;
    c.diagnostics.report(DiagnosticKind::OutputNotWritten, access.span, {access.name, c.context.pass.name})
        .note(DiagnosticKind::ShaderOfPass, (fragment != nullptr ? *fragment : c.stages.front()).span, {c.context.pass.name});
  }
}

void check_per_draw(const Checker& c) {
  if (!c.context.pass.draw.per_draw.valid()) return;
  const auto uses_it = [](const StageOutput& stage) { return stage.reflection.push_constants_used; };
  if (std::any_of(c.stages.begin(), c.stages.end(), uses_it)) return;
  c.diagnostics.report(DiagnosticKind::UnusedAccess, c.context.pass.span, {"per_draw", c.context.pass.name})
      .note(DiagnosticKind::ShaderOfPass, c.stages.front().span, {c.context.pass.name});
}

// The compiler must lay structs out as the front end computed, or C++ and GLSL would disagree.
void check_layouts(const Checker& c, const StageOutput& stage) {
  for (const ReflectedStruct& found : stage.reflection.structs) {
    for (const dsl::Struct& record : c.context.program.structs) {
      if (record.name != found.name || record.fields.size() != found.offsets.size()) continue;
      for (size_t i = 0; i < record.fields.size(); ++i)
        RG_CHECK(found.offsets[i] == (found.std140 ? record.fields[i].offset140 : record.fields[i].offset430),
                 "a struct's layout differs between the front end and the shader compiler");
    }
  }
}

}  // namespace

std::string stage_name(dsl::Stage stage) {
  switch (stage) {
    case dsl::stage_vertex:
      return "vertex";
    case dsl::stage_tess_control:
      return "tess_control";
    case dsl::stage_tess_eval:
      return "tess_eval";
    case dsl::stage_geometry:
      return "geometry";
    case dsl::stage_fragment:
      return "fragment";
    default:
      return "compute";
  }
}

void check_agreement(const PassContext& context, const std::vector<StageOutput>& stages, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  const Checker c{context, stages, places, diagnostics};
  const std::vector<InterfaceBinding> bindings = pass_bindings(context.program, context.graph, context.pass);
  for (const InterfaceBinding& binding : bindings) {
    check_used(c, binding);
    if (binding.access == dsl::kAll) continue;
    const dsl::Access& access = context.pass.accesses[binding.access];
    for (const StageOutput& stage : stages) check_mode(c, stage, binding, access);
    for (const StageOutput& stage : stages) check_declared_stages(c, stage, binding, access);
    check_update(c, binding, access);
  }
  check_per_draw(c);
  check_outputs(c);
  for (const StageOutput& stage : stages) {
    check_own_descriptors(c, stage, bindings);
    check_layouts(c, stage);
  }
}

void check_stages(const dsl::Pass& pass, dsl::Diagnostics& diagnostics) {
  uint32_t named = 0;
  for (const dsl::Shader& shader : pass.shaders) named |= shader.stage;
  if (named == 0) return;
  const auto report = [&](const char* what) { diagnostics.report(DiagnosticKind::StagesIncomplete, pass.shaders.front().span, {pass.name, what}); };
  if (pass.kind == dsl::PassKind::compute && named != dsl::stage_compute) return report("a shader that is no compute shader");
  if (pass.kind != dsl::PassKind::raster) return;
  if ((named & dsl::stage_compute) != 0) return report("a compute shader but is a raster pass");
  if (pass.draw.kind == dsl::DrawKind::fullscreen && (named & dsl::stage_fragment) == 0) return report("no fragment shader to fill the screen with");
  if (pass.draw.kind != dsl::DrawKind::fullscreen && (named & dsl::stage_vertex) == 0) return report("no vertex shader");
  const uint32_t tessellation = dsl::stage_tess_control | dsl::stage_tess_eval;
  if ((named & tessellation) != 0 && (named & tessellation) != tessellation) return report("only one of the two tessellation shaders");
}

}  // namespace rg::compiler
