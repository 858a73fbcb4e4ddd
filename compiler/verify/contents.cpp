#include "compiler/verify/contents.h"

#include <algorithm>
#include <map>

namespace rg::verify {
namespace {

using Version = uint64_t;
constexpr Version kPoison = 0;

Version mix(uint64_t a, uint64_t b) {
  uint64_t x = a * 0x9E3779B97F4A7C15u + b + 0x2545F4914F6CDD1Du;
  x ^= x >> 31;
  x *= 0xBF58476D1CE4E5B9u;
  x ^= x >> 29;
  return x | 1;
}

// What the host decides: which conditions hold in which frame, how many mips each image has.
struct Outcome {
  std::vector<bool> even, odd;  // by condition, in even and odd frames
  std::vector<uint32_t> mips;   // by program resource
};

bool is_active(const Outcome& outcome, const dsl::Pass& pass, uint32_t frame) {
  for (const dsl::ConditionId condition : pass.conditions)
    if (!(frame % 2 ? outcome.odd : outcome.even)[condition.value]) return false;
  for (const dsl::MipLimit& limit : pass.mip_limits)
    if (limit.mip >= outcome.mips[limit.image.value]) return false;
  return true;
}

// What a location holds: what the last writer left that does not commute with its neighbours, and what commuting ones have added since.
struct Content {
  Version base = kPoison, added = 0;
  Content(Version version = kPoison) : base(version) {}
  Version version() const { return base + added; }
};

// One of the two executions: what the memory of all copies holds.
struct Memory {
  std::vector<Content> contents;  // by cell of the model
};

struct Comparison {
  const Model& model;
  Report& report;
  const Outcome& outcome;
  // By program pass: its accesses, as cells (of all passes the configuration selects, planned or not).
  const std::vector<std::vector<Use>>& program_uses;
  uint32_t frame = 0;

  uint32_t physical(uint32_t resource, uint32_t age, uint32_t cell) const {
    const uint32_t copies = model.resources[resource].copies;
    return model.cell(resource, (frame + copies - age % copies) % copies, cell);
  }
  bool exists(uint32_t resource, uint32_t cell) const {
    const Partition& partition = model.resources[resource].partition;
    return !partition.shape.image || first_mip_of_cell(partition, cell) < outcome.mips[resource];
  }
};

constexpr uint64_t kImportNames = 0x10000000, kInitialNames = 0x20000000;
Version version_of_pass(uint32_t pass, uint32_t frame) { return mix(pass + 1, frame + 1); }
Version version_of_import(uint32_t resource, uint32_t frame) { return mix(resource + kImportNames, frame + 1); }
Version version_of_start(uint32_t resource) { return mix(resource + kInitialNames, 0); }

// Searches, because only findings ask.
std::string name_of(const Comparison& c, Version version) {
  if (version == kPoison) return "undefined contents";
  const dsl::Graph& graph = c.model.input->graph;
  for (uint32_t frame = 0; frame <= c.frame; ++frame) {
    const std::string when = " in frame " + std::to_string(frame);
    for (uint32_t p = 0; p < graph.passes.size(); ++p)
      if (version == version_of_pass(p, frame)) return "what `" + graph.passes.rows[p].name + "` wrote" + when;
    for (uint32_t r = 0; r < graph.resources.size(); ++r)
      if (version == version_of_import(r, frame)) return "what was imported" + when;
  }
  for (uint32_t r = 0; r < graph.resources.size(); ++r)
    if (version == version_of_start(r)) return "the initial contents";
  return "another mixture of writes";
}

// What the write leaves, given what was there.
Content written(const Comparison& c, uint32_t pass, const Use& use, Content old) {
  const Version own = version_of_pass(pass, c.frame);
  if (!use.commutes) return own;
  old.added += own;
  return old;
}

// ---- program order ----------------------------------------------------------------------------------------------

// What each access of each pass finds, by pass, access and cell of the use.
using Found = std::vector<std::vector<std::vector<Content>>>;

void run_program_pass(Comparison& c, uint32_t pass, Memory& memory, Found& found) {
  const std::vector<Use>& uses = c.program_uses[pass];
  for (size_t u = 0; u < uses.size(); ++u)
    for (size_t i = 0; i < uses[u].cells.size(); ++i)
      found[pass][u][i] = memory.contents[c.physical(uses[u].resource, uses[u].age, uses[u].cells[i])];
  for (const Use& use : uses)
    if (use.writes)
      for (const uint32_t cell : use.cells) {
        Content& content = memory.contents[c.physical(use.resource, use.age, cell)];
        content = written(c, pass, use, content);
      }
}

// A history resource that a frame does not write keeps its last version.
void begin_program_frame(Comparison& c, Memory& memory) {
  for (uint32_t r = 0; r < c.model.resources.size(); ++r) {
    const ResourceNode& node = c.model.resources[r];
    if (c.model.resource(r).lifetime != dsl::Lifetime::history) continue;
    for (uint32_t cell = 0; cell < node.partition.cell_count(); ++cell)
      memory.contents[c.physical(r, 0, cell)] = memory.contents[c.physical(r, 1, cell)];
  }
}

// Transients, read-backs and imports are new in every frame, for program and plan alike.
void begin_frame(Comparison& c, Memory& memory) {
  for (uint32_t r = 0; r < c.model.resources.size(); ++r) {
    const dsl::Resource& resource = c.model.resource(r);
    for (uint32_t cell = 0; cell < c.model.resources[r].partition.cell_count(); ++cell) {
      Content& now = memory.contents[c.physical(r, 0, cell)];
      if (resource.lifetime == dsl::Lifetime::transient || resource.lifetime == dsl::Lifetime::readback) now = kPoison;
      if (resource.lifetime != dsl::Lifetime::imported) continue;
      now = resource.before.role == dsl::Role::undefined ? kPoison : version_of_import(r, c.frame);
    }
  }
}

void begin_life(Comparison& c, Memory& memory) {
  memory.contents.assign(c.model.cell_count, kPoison);
  for (uint32_t r = 0; r < c.model.resources.size(); ++r) {
    const dsl::Resource& resource = c.model.resource(r);
    const bool kept = resource.lifetime == dsl::Lifetime::history || resource.lifetime == dsl::Lifetime::persistent;
    if (!kept || resource.init == dsl::InitKind::none) continue;
    const Version initial = version_of_start(r);
    const ResourceNode& node = c.model.resources[r];
    std::fill_n(memory.contents.begin() + node.first_cell, node.copies * node.partition.cell_count(), initial);
  }
}

// ---- the plan ---------------------------------------------------------------------------------------------------

void report_read(Comparison& c, uint32_t plan_pass, const Use& use, uint32_t cell, Version wanted, Version actual) {
  const std::string pass = c.model.pass_name(plan_pass);
  const std::string text = "`" + pass + "` reads " + c.model.place(use.resource, cell) +
                           (use.age ? " of " + std::to_string(use.age) + (use.age == 1 ? " frame ago" : " frames ago") : "") + ": it finds " +
                           name_of(c, actual) + ", program order gives " + name_of(c, wanted);
  c.report.add({actual == kPoison ? Hazard::poison_read : Hazard::wrong_version, c.model.resource(use.resource).name, "", pass, text});
}

// Operations on slices leave the others; what they do to their own, the access declares.
bool loads(const Use& use, const PassNode& node) { return !use.attachment || !node.first_in_rendering || use.load == LoadOp::load || use.own_slices; }

void report_load(Comparison& c, uint32_t plan_pass, const Use& use, const std::string& text) {
  const std::string pass = c.model.pass_name(plan_pass);
  c.report.add({Hazard::lost_contents, c.model.resource(use.resource).name, "", pass,
                "`" + pass + "` " + text + " " + c.model.place(use.resource, use.cells.empty() ? 0 : use.cells.front())});
}

void compare_read(Comparison& c, const PassNode& node, const Use& use, size_t index, const Content& wanted, const Content& actual) {
  const uint32_t cell = use.cells[index];
  if (use.attachment && node.first_in_rendering && (use.load == LoadOp::clear) != use.clears)
    report_load(c, node.plan_pass, use, use.clears ? "does not clear" : "clears");
  if (use.attachment && node.first_in_rendering && use.load == LoadOp::load && actual.version() == kPoison && !use.clears)
    report_load(c, node.plan_pass, use, "loads undefined contents of");
  if (!use.uses_contents || wanted.version() == kPoison) return;
  const Content seen = loads(use, node) ? actual : Content();
  // Among commuting writers only the sum counts, which their reader finds; but they have to add to the same.
  const bool same = use.commutes ? seen.version() != kPoison && seen.base == wanted.base : seen.version() == wanted.version();
  if (same) return;
  report_read(c, node.plan_pass, use, cell, use.commutes ? wanted.base : wanted.version(), use.commutes ? seen.base : seen.version());
}

void run_plan_pass(Comparison& c, const PassNode& node, Memory& memory, const Found& found) {
  const auto at = [&](const Use& use, size_t i) -> Content& { return memory.contents[c.physical(use.resource, use.age, use.cells[i])]; };
  std::vector<std::pair<uint32_t, Content>> results;
  for (const Use& use : node.uses)
    for (size_t i = 0; i < use.cells.size(); ++i) {
      if (!c.exists(use.resource, use.cells[i])) continue;
      const Content actual = at(use, i);
      compare_read(c, node, use, i, found[node.program_pass][use.access][i], actual);
      const bool drops = use.attachment && node.last_in_rendering && use.store != StoreOp::store;
      Content next = use.writes ? written(c, node.program_pass, use, actual) : actual;
      if (drops && (use.writes || use.store == StoreOp::dont_care)) next = kPoison;
      if (use.writes || drops) results.emplace_back(c.physical(use.resource, use.age, use.cells[i]), next);
    }
  for (const auto& [cell, content] : results) memory.contents[cell] = content;
}

void run_plan_group(Comparison& c, const GroupNode& group, Memory& memory) {
  for (const uint32_t id : group.scopes) {
    const Scope& scope = c.model.scopes[id];
    if (scope.kind != ScopeKind::image || scope.old_layout != Layout::undefined) continue;
    for (const uint32_t cell : scope.cells) memory.contents[c.physical(scope.resource, scope.age, cell)] = kPoison;
  }
}

bool is_observable(const dsl::Resource& resource) {
  if (resource.is_output) return true;
  if (resource.lifetime == dsl::Lifetime::imported) return resource.after.role != dsl::Role::undefined;
  return resource.lifetime != dsl::Lifetime::transient;
}

void compare_end(Comparison& c, const Memory& program, const Memory& plan) {
  for (uint32_t r = 0; r < c.model.resources.size(); ++r) {
    const dsl::Resource& resource = c.model.resource(r);
    const ResourceNode& node = c.model.resources[r];
    if (!is_observable(resource) || !is_selected(resource.guard, c.model.input->configuration)) continue;
    for (uint32_t age = 0; age < node.copies; ++age)
      for (uint32_t cell = 0; cell < node.partition.cell_count(); ++cell) {
        const uint32_t at = c.physical(r, age, cell);
        const Version wanted = program.contents[at].version(), actual = plan.contents[at].version();
        if (wanted == actual || wanted == kPoison || !c.exists(r, cell)) continue;
        const Hazard hazard = actual == kPoison ? Hazard::lost_contents : Hazard::wrong_version;
        c.report.add({hazard, resource.name, "", "",
                      "at the end of frame " + std::to_string(c.frame) + " " + c.model.place(r, cell) +
                          (age ? " of " + std::to_string(age) + (age == 1 ? " frame ago" : " frames ago") : "") + " holds " + name_of(c, actual) +
                          ", program order gives " + name_of(c, wanted)});
      }
  }
}

Found room_for(const std::vector<std::vector<Use>>& uses) {
  Found found;
  for (const std::vector<Use>& pass : uses) {
    found.emplace_back();
    for (const Use& use : pass) found.back().emplace_back(use.cells.size());
  }
  return found;
}

void run_frame(Comparison& c, Memory& program, Memory& plan, Found& found) {
  begin_program_frame(c, program);
  begin_frame(c, program);
  begin_frame(c, plan);
  for (uint32_t pass = 0; pass < c.program_uses.size(); ++pass) {
    const dsl::Pass& row = c.model.input->graph.passes.rows[pass];
    if (is_selected(row.guard, c.model.input->configuration) && is_active(c.outcome, row, c.frame)) run_program_pass(c, pass, program, found);
  }
  for (const StepNode& step : c.model.steps) {
    if (!step.is_pass)
      run_plan_group(c, c.model.groups[step.index], plan);
    else if (is_active(c.outcome, c.model.pass(step.index), c.frame))
      run_plan_pass(c, c.model.passes[step.index], plan, found);
  }
  compare_end(c, program, plan);
}

// ---- outcomes ---------------------------------------------------------------------------------------------------

Outcome uniform(const Model& model, bool on) {
  Outcome outcome;
  outcome.even.assign(model.input->program.conditions.size(), on);
  outcome.odd = outcome.even;
  for (const dsl::Resource& resource : model.input->graph.resources) outcome.mips.push_back(std::max(resource.mips, 1u));
  return outcome;
}

void add_condition_outcomes(const Model& model, std::vector<Outcome>& outcomes) {
  std::vector<uint32_t> used;
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::ConditionId condition : pass.conditions) used.push_back(condition.value);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.empty()) return;
  outcomes.push_back(uniform(model, false));
  Outcome alternating = uniform(model, true);
  alternating.odd.assign(alternating.odd.size(), false);
  outcomes.push_back(alternating);
  constexpr size_t kExhaustive = 5;
  if (used.size() <= kExhaustive) {
    for (uint32_t bits = 1; bits + 1 < 1u << used.size(); ++bits) {
      Outcome outcome = uniform(model, true);
      for (size_t i = 0; i < used.size(); ++i) outcome.even[used[i]] = outcome.odd[used[i]] = bits >> i & 1;
      outcomes.push_back(outcome);
    }
    return;
  }
  for (const uint32_t condition : used)
    for (const bool on : {true, false}) {
      Outcome outcome = uniform(model, !on);
      outcome.even[condition] = outcome.odd[condition] = on;
      outcomes.push_back(outcome);
    }
}

void add_mip_outcomes(const Model& model, std::vector<Outcome>& outcomes) {
  std::map<uint32_t, uint32_t> limited;  // image to largest limit
  for (const dsl::Pass& pass : model.input->graph.passes)
    for (const dsl::MipLimit& limit : pass.mip_limits) limited[limit.image.value] = std::max(limited[limit.image.value], limit.mip);
  if (limited.empty()) return;
  uint32_t longest = 0;
  for (const auto& [image, mip] : limited) longest = std::max(longest, mip);
  // Images of one extent lose their mips together.
  for (uint32_t mips = 1; mips <= longest; ++mips) {
    Outcome outcome = uniform(model, true);
    for (const auto& [image, mip] : limited) outcome.mips[image] = std::min(outcome.mips[image], mips);
    outcomes.push_back(outcome);
  }
  constexpr size_t kEachAlone = 16;
  if (limited.size() > kEachAlone) return;
  for (const auto& [image, mip] : limited)
    for (uint32_t mips = 1; mips <= mip; ++mips) {
      Outcome outcome = uniform(model, true);
      outcome.mips[image] = mips;
      outcomes.push_back(outcome);
    }
}

std::vector<std::vector<Use>> make_program_uses(const Model& model, const std::vector<int64_t>& extents) {
  std::vector<std::vector<Use>> result;
  for (const dsl::Pass& pass : model.input->graph.passes) {
    std::vector<Use>& uses = result.emplace_back();
    for (const dsl::Access& access : pass.accesses) {
      const Partition& partition = model.resources[access.resource.value].partition;
      Use use;
      use.resource = access.resource.value;
      use.age = access.age;
      use.cells = cells_in(partition, box_of(model.input->program, partition.shape, effective_range(access, partition.shape.aspects), extents));
      use.writes = writes_contents(access);
      use.commutes = commutes(access);
      uses.push_back(std::move(use));
    }
  }
  return result;
}

}  // namespace

void replay_contents(const Model& model, const std::vector<int64_t>& extents, Report& report) {
  std::vector<Outcome> outcomes{uniform(model, true)};
  add_condition_outcomes(model, outcomes);
  add_mip_outcomes(model, outcomes);
  const std::vector<std::vector<Use>> uses = make_program_uses(model, extents);
  Found found = room_for(uses);
  for (const Outcome& outcome : outcomes) {
    Comparison comparison{model, report, outcome, uses, 0};
    Memory program, plan;
    begin_life(comparison, program);
    begin_life(comparison, plan);
    for (; comparison.frame < model.history + 3 && !report.full(); ++comparison.frame) run_frame(comparison, program, plan, found);
    if (report.full()) return;
  }
}

}  // namespace rg::verify
