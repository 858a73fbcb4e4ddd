#include "compiler/verify/redundancy.h"

#include <algorithm>
#include <bit>
#include <random>
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

// Of the extents: those of the model, then all corners of their bounds where those are few, and some between them. What is linear in every extent, as
// sizes are but for rounding, is least and greatest in corners.
std::vector<std::vector<int64_t>> sampled_extents(const dsl::Program& program, const std::vector<int64_t>& here) {
  constexpr size_t kMostAxes = 6, kRandom = 200;
  std::vector<int64_t> least, greatest;
  for (const dsl::Extent& extent : program.extents)
    least.insert(least.end(), extent.minimum, extent.minimum + 3), greatest.insert(greatest.end(), extent.maximum, extent.maximum + 3);
  std::vector<size_t> axes;
  for (size_t i = 0; i < least.size(); ++i)
    if (least[i] != greatest[i]) axes.push_back(i);
  std::vector<std::vector<int64_t>> samples = {here};
  for (size_t corner = 0; axes.size() <= kMostAxes && corner < size_t{1} << axes.size(); ++corner) {
    samples.push_back(least);
    for (size_t i = 0; i < axes.size(); ++i)
      if (corner >> i & 1) samples.back()[axes[i]] = greatest[axes[i]];
  }
  std::mt19937_64 random(1);
  for (size_t i = 0; i < kRandom; ++i) {
    samples.push_back(least);
    for (const size_t axis : axes) samples.back()[axis] += static_cast<int64_t>(random() % static_cast<uint64_t>(greatest[axis] - least[axis] + 1));
  }
  return samples;
}

using Edge = std::vector<int64_t>;  // of a range of bytes, by sample; the first is the model's

// Whether the ranges lie to one another as they do in the model in all samples, but for pieces that are empty elsewhere.
bool lie_alike(const std::vector<Edge>& edges) {
  constexpr size_t kMostEdges = 64;
  if (edges.size() > kMostEdges) return false;
  for (const Edge& a : edges)
    for (const Edge& b : edges) {
      if (&a == &b) continue;
      if (a[0] == b[0]) return false;
      for (size_t i = 1; i < a.size(); ++i)
        if (a[0] < b[0] && a[i] > b[i]) return false;
    }
  return true;
}

// Buffers of which passes touch ranges that depend on extents and lie otherwise at others: what these extents do not need, others may.
std::vector<bool> cut_by_extents(const Model& model, const std::vector<int64_t>& extents) {
  const dsl::Program& program = model.input->program;
  std::vector<bool> varies(model.resources.size());
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::Access& access : pass.accesses)
      if (!is_constant(program, access.range.offset) || !is_constant(program, access.range.size)) varies[access.resource.value] = true;
  if (std::find(varies.begin(), varies.end(), true) == varies.end()) return varies;
  const std::vector<std::vector<int64_t>> samples = sampled_extents(program, extents);
  std::vector<std::vector<Edge>> edges(varies.size(), {Edge(samples.size(), 0)});
  const auto add = [&](uint32_t resource, dsl::ExprId offset, dsl::ExprId size, int64_t stride) {
    Edge edge;
    for (const std::vector<int64_t>& sample : samples)
      edge.push_back((offset.valid() ? dsl::evaluate(program, offset, sample) : 0) +
                     (size.valid() ? dsl::evaluate(program, size, sample) * stride : 0));
    if (std::find(edges[resource].begin(), edges[resource].end(), edge) == edges[resource].end()) edges[resource].push_back(std::move(edge));
  };
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::Access& access : pass.accesses) {
      if (!varies[access.resource.value] || !access.range.offset.valid()) continue;
      add(access.resource.value, access.range.offset, {}, 1);
      add(access.resource.value, access.range.offset, access.range.size, 1);
    }
  for (uint32_t r = 0; r < varies.size(); ++r) {
    if (!varies[r]) continue;
    const dsl::Resource& buffer = model.input->graph.resources.rows[r];
    if (buffer.count.valid()) add(r, {}, buffer.count, buffer.stride);
    varies[r] = !lie_alike(edges[r]);
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
