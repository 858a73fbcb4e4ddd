// What keeps a block out of a kernel.
#include <algorithm>

#include "compiler/fusion/fuse_passes.h"
#include "compiler/fusion/write_kernel.h"

namespace rg::compiler {
namespace {

using dsl::Mode;

constexpr uint64_t kSharedLimit = 16384;  // bytes that every Vulkan device has

struct Pair {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const dsl::Pass &before, &next;
};
using Found = std::optional<Obstacle>;

Obstacle obstacle(std::string why, std::vector<std::pair<dsl::Span, std::string>> places = {}) { return {std::move(why), std::move(places)}; }

bool apart(uint32_t a, uint32_t a_count, uint32_t b, uint32_t b_count) {
  const uint64_t a_end = a_count == dsl::kAll ? UINT64_MAX : uint64_t{a} + a_count, b_end = b_count == dsl::kAll ? UINT64_MAX : uint64_t{b} + b_count;
  return a_end <= b || b_end <= a;
}

bool overlap(const dsl::Access& a, const dsl::Access& b) {
  if (a.resource != b.resource || a.age != b.age) return false;
  const bool aspects = a.range.aspects == 0 || b.range.aspects == 0 || (a.range.aspects & b.range.aspects) != 0;
  return aspects && !apart(a.range.mip, a.range.mips, b.range.mip, b.range.mips) &&
         !apart(a.range.layer, a.range.layers, b.range.layer, b.range.layers);
}

bool conflict(const dsl::Access& a, const dsl::Access& b) { return overlap(a, b) && (a.mode != Mode::read || b.mode != Mode::read); }

bool both_atomic(const dsl::Access& a, const dsl::Access& b) {
  return a.mode == Mode::atomic && b.mode == Mode::atomic && a.range == b.range && a.view == b.view;
}

const char* does(const dsl::Access& access) {
  if (access.mode == Mode::atomic) return "counts in";
  return access.mode == Mode::read ? "reads" : "writes";
}

// "`light` reads `density` at any element"
std::string deed(const dsl::Graph& graph, const dsl::Pass& pass, const dsl::Access& access) {
  return "`" + pass.name + "` " + does(access) + " `" + graph.resources[access.resource].name + "` " +
         (access.element ? "at its own element" : "at any element");
}

Obstacle clash(const dsl::Graph& graph, const dsl::Pass& a, const dsl::Access& left, const dsl::Pass& b, const dsl::Access& right) {
  const bool views = left.element && right.element;
  const std::string why =
      views ? "they see `" + graph.resources[left.resource].name + "` in different ways" : deed(graph, b, right) + ", and " + deed(graph, a, left);
  return obstacle(why, {{left.span, deed(graph, a, left)}, {right.span, deed(graph, b, right)}});
}

Found different_place(const Pair& at) {
  if (at.before.queue != at.next.queue || at.before.queue_may != at.next.queue_may) return obstacle("they ask for different queues");
  if (at.before.guard != at.next.guard) return obstacle("they run under different features");
  if (at.before.conditions != at.next.conditions) return obstacle("they run under different conditions of the host");
  if (at.before.mip_limits != at.next.mip_limits) return obstacle("they are skipped at different sizes");
  if (!at.before.bind.empty() && !at.next.bind.empty() && at.before.bind != at.next.bind) return obstacle("they bind different sets");
  return {};
}

Found different_domain(const Pair& at) {
  if (at.before.block->axes != at.next.block->axes || !std::equal(at.before.dispatch.size, at.before.dispatch.size + 3, at.next.dispatch.size))
    return obstacle("`" + at.before.name + "` runs over other elements");
  const uint32_t a = at.before.block->scan, b = at.next.block->scan;
  if (a != dsl::kAll && b != dsl::kAll && a != b) return obstacle("`" + at.before.name + "` scans along another axis");
  return {};
}

Found touching(const Pair& at) {
  for (const dsl::Access& left : at.before.accesses)
    for (const dsl::Access& right : at.next.accesses)
      if (conflict(left, right) && !same_cell(left, right) && !both_atomic(left, right)) return clash(at.graph, at.before, left, at.next, right);
  return {};
}

// A pass between them will run before all of them.
Found between(const dsl::Graph& graph, const std::vector<dsl::PassId>& group, dsl::PassId next) {
  for (uint32_t p = group.front().value + 1; p < next.value; ++p) {
    if (std::find(group.begin(), group.end(), dsl::PassId{size_t{p}}) != group.end()) continue;
    const dsl::Pass& other = graph.passes.rows[p];
    for (const dsl::PassId member : group) {
      if (member.value > p) continue;
      const dsl::Pass& pass = graph.passes[member];
      if (std::find(other.after.begin(), other.after.end(), member) != other.after.end())
        return obstacle("`" + other.name + "` between them runs after `" + pass.name + "`", {{other.span, "it stands here"}});
      for (const dsl::Access& left : pass.accesses)
        for (const dsl::Access& right : other.accesses)
          if (conflict(left, right))
            return obstacle("`" + other.name + "` between them touches `" + graph.resources[left.resource].name + "`, which `" + pass.name + "` " +
                                (left.mode == Mode::read ? "reads" : "writes"),
                            {{left.span, deed(graph, pass, left)}, {right.span, "`" + other.name + "` touches it"}});
    }
  }
  return {};
}

// A parameter block of a pass belongs to that pass alone.
Found owned_params(const dsl::Graph& graph, const dsl::Pass& pass) {
  if (!pass.fusion.valid() || !graph.fusions[pass.fusion].when) return {};
  for (const dsl::ParamsUse& use : pass.params)
    if (graph.params[use.id].pass.valid())
      return obstacle("its parameter block `" + graph.params[use.id].name + "` would belong to two passes; make it a parameter of the graph",
                      {{graph.params[use.id].span, "it is declared here"}});
  return {};
}

Found too_large(const dsl::Program& program, const std::vector<const dsl::Pass*>& members) {
  const uint64_t bytes = shared_bytes(program, members);
  if (bytes <= kSharedLimit) return {};
  return obstacle("what they carry takes " + std::to_string(bytes) + " bytes of shared memory, and devices have " + std::to_string(kSharedLimit));
}

}  // namespace

Found find_obstacle(const dsl::Program& program, const dsl::Graph& graph, const std::vector<dsl::PassId>& group, dsl::PassId next) {
  const dsl::Pass& pass = graph.passes[next];
  if (!pass.block) return obstacle("it is no block", {{pass.span, "it is declared here"}});
  if (const Found own = owned_params(graph, pass)) return own;
  std::vector<const dsl::Pass*> members;
  for (const dsl::PassId id : group) {
    const Pair pair{program, graph, graph.passes[id], pass};
    for (const auto& check : {different_place, different_domain, touching})
      if (Found found = check(pair)) return found;
    members.push_back(&pair.before);
  }
  members.push_back(&pass);
  if (group.empty()) return {};
  if (Found found = between(graph, group, next)) return found;
  return too_large(program, members);
}

}  // namespace rg::compiler
