#include "compiler/verify/redundancy.h"

#include <bit>
#include <string>

namespace rg::verify {
namespace {

struct Mask {
  AtomField field;
  uint64_t bits;
  const char* what;
  bool stages;
};

std::string bit_name(const Mask& mask, uint64_t bit) {
  const uint32_t set = mask.stages ? expand_stages(bit) : expand_accesses(bit);
  if (!std::has_single_bit(set)) return "bit " + std::to_string(std::countr_zero(bit));
  const auto index = static_cast<uint32_t>(std::countr_zero(set));
  return mask.stages ? stage_name(index) : access_name(index);
}

std::string scope_text(const Model& model, const Scope& scope) {
  const char* kinds[] = {"memory barrier ", "image barrier ", "buffer barrier ", "wait ", "signal "};
  std::string text = kinds[static_cast<size_t>(scope.kind)] + std::to_string(scope.index);
  if (scope.kind == ScopeKind::wait || scope.kind == ScopeKind::signal) text += " of " + model.queue_name(scope.queue);
  if (scope.has_range())
    text += " on " + (scope.cells.empty() ? "`" + model.resource(scope.resource).name + "`" : model.place(scope.resource, scope.cells.front()));
  return text;
}

void report_atom(const Model& model, const Scope& scope, const std::string& text, Report& report) {
  const std::string resource = scope.has_range() ? model.resource(scope.resource).name : "";
  report.add({Hazard::redundant, resource, "", "", scope_text(model, scope) + text});
}

// The last signal of a queue tells the host, and the frames of other plans, that all is done.
bool retires_frame(const Model& model, const Scope& scope) { return scope.kind == ScopeKind::signal && scope.value == model.signals_on[scope.queue]; }

bool is_constant(const dsl::Program& program, dsl::ExprId id) { return !id.valid() || program.exprs[id].op == dsl::ExprOp::constant; }

// Buffers of which passes touch ranges that depend on extents: what these extents do not need, others may.
std::vector<bool> cut_by_extents(const Model& model) {
  std::vector<bool> found(model.resources.size());
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::Access& access : pass.accesses)
      if (!is_constant(model.input->program, access.range.offset) || !is_constant(model.input->program, access.range.size))
        found[access.resource.value] = true;
  return found;
}

}  // namespace

void check_redundancy(const Model& model, const std::vector<bool>& required, Report& report) {
  const std::vector<bool> varies = cut_by_extents(model);
  for (uint32_t id = 0; id < model.scopes.size(); ++id) {
    const Scope& scope = model.scopes[id];
    if (scope.kind == ScopeKind::buffer && varies[scope.resource]) continue;
    if (scope.tag != BarrierTag::hazard || retires_frame(model, scope)) continue;
    if (!required[atom_of(id, AtomField::whole)]) {
      report_atom(model, scope, " can be removed", report);
      continue;
    }
    if (scope.kind == ScopeKind::wait && scope.value > 1 && !required[atom_of(id, AtomField::value)])
      report_atom(model, scope, ": it could wait for value " + std::to_string(scope.value - 1), report);
    const Mask masks[] = {{AtomField::src_stage, scope.raw_src, "source stage", true},
                          {AtomField::src_access, scope.raw_src_accesses, "source access", false},
                          {AtomField::dst_stage, scope.raw_dst, "destination stage", true},
                          {AtomField::dst_access, scope.raw_dst_accesses, "destination access", false}};
    for (const Mask& mask : masks) {
      // A semaphore operation in no stage is none at all.
      if (mask.stages && scope.kind != ScopeKind::memory && !scope.has_range() && std::has_single_bit(mask.bits)) continue;
      for (uint64_t rest = mask.bits; rest != 0; rest &= rest - 1) {
        const uint64_t bit = rest & ~(rest - 1);
        if (!required[atom_of(id, mask.field, static_cast<uint32_t>(std::countr_zero(bit)))])
          report_atom(model, scope, std::string(": ") + mask.what + " " + bit_name(mask, bit) + " can be removed", report);
      }
    }
  }
}

}  // namespace rg::verify
