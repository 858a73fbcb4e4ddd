#include "compiler/machine/reference.h"

#include <algorithm>

#include "compiler/machine/hardware.h"

namespace rg::machine {
namespace {

uint64_t mix(uint64_t hash, uint64_t value) {  // splitmix64
  hash += value + 0x9E3779B97F4A7C15u;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9u;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBu;
  return hash ^ (hash >> 31);
}
enum Origin : uint64_t { by_pass = 1, by_init, by_import, by_group, by_share };
uint64_t term(Origin origin, uint64_t frame, uint64_t who, uint64_t resource) { return mix(mix(mix(mix(1, origin), frame), who), resource); }

struct Interpreter {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const std::vector<uint32_t>& configuration;
  const Cells& cells;
  const MachineOptions& options;
  Reference result = {};
  std::vector<std::vector<Version>> now = {};
  std::vector<uint32_t> group = {};  // by resource: counts groups of commuting neighbours this frame
  std::vector<bool> group_open = {};

  bool holds(const dsl::Guard& guard) const {
    return std::all_of(guard.terms.begin(), guard.terms.end(),
                       [&](const dsl::Guard::Term& term) { return (configuration[term.feature.value] == term.value) != term.negated; });
  }
  bool runs(const dsl::Pass& pass, uint32_t frame) const {
    if (!holds(pass.guard)) return false;
    for (const dsl::ConditionId condition : pass.conditions)
      if (((conditions_in(options, frame) >> condition.value) & 1) == 0) return false;
    return std::all_of(pass.mip_limits.begin(), pass.mip_limits.end(),
                       [&](const dsl::MipLimit& limit) { return limit.mip < mips_at(program, graph.resources[limit.image], cells.extents); });
  }

  void start() {
    for (uint32_t r = 0; r < graph.resources.size(); ++r) {
      const dsl::Resource& resource = graph.resources.rows[r];
      Version version;
      if (resource.lifetime == dsl::Lifetime::history || resource.lifetime == dsl::Lifetime::persistent) version.base = term(by_init, 0, 0, r);
      if (version.base) result.names[version.base] = "the initial value";
      now.emplace_back(cells.resources[r].pieces.size(), version);
    }
    result.initial = now;
  }
  void start_frame(uint32_t frame) {
    group.assign(graph.resources.size(), 0);
    group_open.assign(graph.resources.size(), false);
    for (uint32_t r = 0; r < graph.resources.size(); ++r) {
      const dsl::Lifetime lifetime = graph.resources.rows[r].lifetime;
      if (lifetime == dsl::Lifetime::history || lifetime == dsl::Lifetime::persistent) continue;
      const Version version = lifetime == dsl::Lifetime::imported ? imported_version(graph, r, frame) : Version{};
      if (version.base) result.names[version.base] = "what the engine brought";
      now[r].assign(now[r].size(), version);
    }
  }

  Version before(uint32_t resource, uint32_t age, uint32_t piece, uint32_t frame) const {
    if (age == 0) return now[resource][piece];
    return frame >= age ? result.finals[frame - age][resource][piece] : result.initial[resource][piece];
  }

  Version after(const dsl::Access& access, Version before, uint64_t defined, uint32_t pass, uint32_t frame) const {
    const uint32_t r = access.resource.value;
    if (access.mode == dsl::Mode::read) return before;
    if (!commutes(access)) return {defined, 0};
    const uint64_t base = access.mode == dsl::Mode::write ? term(by_group, frame, group[r], r) : before.base;
    return {base, (base == before.base ? before.sum : 0) + term(by_share, frame, pass, r)};
  }

  Effect perform(const dsl::Access& access, uint32_t pass, uint32_t frame) {
    const uint32_t r = access.resource.value;
    if (commutes(access) && !group_open[r]) ++group[r];
    group_open[r] = commutes(access);
    const uint64_t defined = term(by_pass, frame, pass, r);
    const std::string writer = "`" + graph.passes.rows[pass].name + "` in frame " + std::to_string(frame);
    result.names[defined] = writer;
    result.names[term(by_group, frame, group[r], r)] = "disjoint writers";
    Effect effect;
    for (const uint32_t piece : pieces_in(cells.resources[r], region_of(program, graph, cells, access))) {
      effect.before.push_back(before(r, access.age, piece, frame));
      effect.after.push_back(after(access, effect.before.back(), defined, pass, frame));
    }
    return effect;
  }

  // Reads see what was there before the pass, writes come after: an update of one range may be declared as two accesses.
  void run_pass(uint32_t index, uint32_t frame) {
    const dsl::Pass& pass = graph.passes.rows[index];
    std::vector<Effect>& effects = result.effects[frame][index];
    if (!runs(pass, frame)) return;
    for (const dsl::Access& access : pass.accesses) effects.push_back(perform(access, index, frame));
    for (size_t i = 0; i < pass.accesses.size(); ++i) {
      const dsl::Access& access = pass.accesses[i];
      if (access.mode == dsl::Mode::read || access.age != 0) continue;
      const Pieces pieces = pieces_in(cells.resources[access.resource.value], region_of(program, graph, cells, access));
      for (size_t k = 0; k < pieces.size(); ++k) now[access.resource.value][pieces[k]] = effects[i].after[k];
    }
  }
};

}  // namespace

std::string Reference::name(Version version) const {
  switch (version.base) {
    case version::undefined:
      return "undefined contents";
    case version::poison:
      return "poison";
    case version::torn:
      return "two unordered writes";
    case version::foreign:
      return "contents of another queue family";
    case version::wrong_layout:
      return "contents in the wrong layout";
    case version::partial:
      return "an unfinished write";
    default:
      break;
  }
  const auto found = names.find(version.base);
  const std::string base = found == names.end() ? "an unknown write" : found->second;
  return version.sum ? base + " and what commuting passes added" : base;
}

bool changes_outside(const dsl::Graph& graph, uint32_t resource) {
  const dsl::Resource& row = graph.resources.rows[resource];
  if (row.before.wrote || row.is_surface || row.before.role == dsl::Role::undefined) return true;
  for (const dsl::Pass& pass : graph.passes)
    for (const dsl::Access& access : pass.accesses)
      if (access.resource.value == resource && access.mode != dsl::Mode::read) return true;
  return false;
}

Version imported_version(const dsl::Graph& graph, uint32_t resource, uint32_t frame) {
  const dsl::Role role = graph.resources.rows[resource].before.role;
  if (role == dsl::Role::undefined) return {version::undefined, 0};
  return {term(by_import, changes_outside(graph, resource) ? frame : 0, 0, resource), 0};
}

uint64_t conditions_in(const MachineOptions& options, uint32_t frame) {
  if (options.conditions.empty()) return 0;
  return options.conditions[std::min<size_t>(frame, options.conditions.size() - 1)];
}

Reference run_in_order(const dsl::Program& program, const dsl::Graph& graph, const std::vector<uint32_t>& configuration, const Cells& cells,
                       const MachineOptions& options) {
  Interpreter interpreter{program, graph, configuration, cells, options};
  interpreter.start();
  interpreter.result.effects.assign(options.frames, std::vector<std::vector<Effect>>(graph.passes.size()));
  for (uint32_t frame = 0; frame < options.frames; ++frame) {
    interpreter.start_frame(frame);
    for (uint32_t pass = 0; pass < graph.passes.size(); ++pass) interpreter.run_pass(pass, frame);
    interpreter.result.finals.push_back(interpreter.now);
  }
  return std::move(interpreter.result);
}

}  // namespace rg::machine
