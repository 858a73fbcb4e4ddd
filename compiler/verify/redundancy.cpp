#include "compiler/verify/redundancy.h"

#include <algorithm>
#include <bit>
#include <string>

#include "dsl/symbolic.h"

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

struct Edge {  // of a range of bytes
  dsl::Polynomial at = dsl::Polynomial(0);
  int64_t here = 0;  // at the extents of the model
};
bool operator==(const Edge& a, const Edge& b) { return a.at.terms() == b.at.terms(); }

// Whether the ranges lie to one another as they do here at all extents, but for pieces that may be empty elsewhere.
bool lie_alike(dsl::Formulas& formulas, const std::vector<Edge>& edges) {
  constexpr size_t kMostEdges = 64;
  if (edges.size() > kMostEdges || std::any_of(edges.begin(), edges.end(), [](const Edge& edge) { return edge.at.overflown(); })) return false;
  for (const Edge& a : edges)
    for (const Edge& b : edges)
      if (!(a == b) && (a.here == b.here || (a.here > b.here && !formulas.never_negative(a.at - b.at)))) return false;
  return true;
}

// Buffers of which passes touch ranges that depend on extents and may lie otherwise at others: what these extents do not need, others may.
std::vector<bool> cut_by_extents(const Model& model, const std::vector<int64_t>& extents) {
  const dsl::Program& program = model.input->program;
  dsl::Formulas formulas(program);
  std::vector<bool> varies(model.resources.size());
  std::vector<std::vector<Edge>> edges(model.resources.size(), {Edge{}});
  const auto add = [&](uint32_t resource, Edge edge) {
    if (std::find(edges[resource].begin(), edges[resource].end(), edge) == edges[resource].end()) edges[resource].push_back(std::move(edge));
  };
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::Access& access : pass.accesses) {
      const dsl::Range& range = access.range;
      if (!range.offset.valid()) continue;
      const uint32_t r = access.resource.value;
      varies[r] = varies[r] || !is_constant(program, range.offset) || !is_constant(program, range.size);
      const Edge begin{formulas.of(range.offset), dsl::evaluate(program, range.offset, extents)};
      add(r, begin);
      add(r, {begin.at + formulas.of(range.size), begin.here + dsl::evaluate(program, range.size, extents)});
    }
  for (uint32_t r = 0; r < varies.size(); ++r) {
    if (!varies[r]) continue;
    const dsl::Resource& buffer = model.input->graph.resources.rows[r];
    if (buffer.count.valid())
      add(r, {formulas.of(buffer.count) * dsl::Polynomial(buffer.stride), dsl::evaluate(program, buffer.count, extents) * buffer.stride});
    varies[r] = !lie_alike(formulas, edges[r]);
  }
  return varies;
}

}  // namespace

void check_redundancy(const Model& model, const std::vector<int64_t>& extents, const std::vector<bool>& required, Report& report) {
  const std::vector<bool> varies = cut_by_extents(model, extents);
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
