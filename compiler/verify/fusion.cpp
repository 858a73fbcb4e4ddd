#include "compiler/verify/fusion.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "compiler/verify/roles.h"

namespace rg::verify {
namespace {

using dsl::Access;
using dsl::Mode;
using dsl::Pass;

// Resource, frames ago, aspect, mip, layer. Buffers are one location: what a block touches of them is not narrowed.
using Location = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, uint32_t>;
using Versions = std::map<Location, std::string>;  // who wrote last; none: nobody in this frame

std::vector<Location> locations(const dsl::Graph& graph, const Access& access) {
  const dsl::Resource& resource = graph.resources[access.resource];
  if (resource.kind == dsl::ResourceKind::buffer) return {{access.resource.value, access.age, 0, 0, 0}};
  const auto end = [](uint32_t first, uint32_t count, uint32_t all) { return count == dsl::kAll ? all : std::min(all, first + count); };
  std::vector<Location> all;
  const uint32_t aspects = access.range.aspects == 0 ? 7 : access.range.aspects;
  for (uint32_t aspect = 1; aspect <= 4; aspect <<= 1)
    for (uint32_t mip = access.range.mip; (aspects & aspect) != 0 && mip < end(access.range.mip, access.range.mips, resource.mips); ++mip)
      for (uint32_t layer = access.range.layer; layer < end(access.range.layer, access.range.layers, resource.layers); ++layer)
        all.emplace_back(access.resource.value, access.age, aspect, mip, layer);
  return all;
}

bool reads(const Access& access) { return access.mode == Mode::read || access.mode == Mode::update; }
bool writes(const Access& access) { return access.mode != Mode::read; }

struct Unit {  // of the program with kernels: a pass and what it runs
  const Pass* pass = nullptr;
  std::vector<const Pass*> members;
};

class Check {
 public:
  Check(const dsl::Graph& written, const dsl::Graph& fused, const std::vector<uint32_t>& configuration, const std::vector<Kernel>& kernels)
      : written_(written), fused_(fused), configuration_(configuration), kernels_(kernels) {}

  std::vector<Finding> run() {
    pair_up();
    if (!findings_.empty()) return std::move(findings_);
    run_written();
    for (const Unit& unit : units_) run_unit(unit);
    check_end();
    return std::move(findings_);
  }

 private:
  void report(Hazard hazard, const dsl::Access* access, const std::string& first, const std::string& second, std::string text) {
    findings_.push_back({hazard, access == nullptr ? "" : written_.resources[access->resource].name, first, second, std::move(text)});
  }

  // ---- who runs whom

  // The first of each name that runs.
  std::unordered_map<std::string_view, const Pass*> by_name(const dsl::Graph& graph) const {
    std::unordered_map<std::string_view, const Pass*> result;
    for (const Pass& pass : graph.passes)
      if (is_selected(pass.guard, configuration_)) result.try_emplace(pass.name, &pass);
    return result;
  }

  std::vector<std::string> members_of(const std::string& pass) const {
    for (const Kernel& kernel : kernels_)
      if (kernel.pass == pass) return kernel.members;
    return {pass};
  }

  void pair_up() {
    const auto as_written = by_name(written_);
    std::unordered_map<std::string, size_t> runs;
    for (const Pass& pass : fused_.passes) {
      if (!is_selected(pass.guard, configuration_)) continue;
      Unit unit{&pass, {}};
      for (const std::string& name : members_of(pass.name)) {
        const auto found = as_written.find(name);
        const Pass* member = found == as_written.end() ? nullptr : found->second;
        if (member == nullptr)
          report(Hazard::missing_pass, nullptr, pass.name, name, "kernel `" + pass.name + "` runs `" + name + "`, which is no pass");
        if (member != nullptr) unit.members.push_back(member);
        ++runs[name];
      }
      units_.push_back(std::move(unit));
    }
    for (const Pass& pass : written_.passes)
      if (is_selected(pass.guard, configuration_) && runs[pass.name] != 1)
        report(Hazard::missing_pass, nullptr, pass.name, "", "`" + pass.name + "` runs " + std::to_string(runs[pass.name]) + " times");
  }

  // ---- versions

  void run_written() {
    for (const Pass& pass : written_.passes) {
      if (!is_selected(pass.guard, configuration_)) continue;
      for (const Access& access : pass.accesses)
        if (reads(access))
          for (const Location& at : locations(written_, access)) seen_[{&access, at}] = last_[at];
      write(pass, last_);
    }
  }

  void write(const Pass& pass, Versions& versions) {
    for (const Access& access : pass.accesses)
      if (writes(access))
        for (const Location& at : locations(written_, access)) versions[at] = pass.name;
  }

  void run_unit(const Unit& unit) {
    for (const Pass* member : unit.members) {
      for (const Access& access : member->accesses) {
        if (!reads(access)) continue;
        for (const Location& at : locations(written_, access)) check_version(unit, *member, access, at);
      }
      write(*member, now_);
    }
    if (unit.members.size() > 1) {
      check_together(unit);
      check_apart(unit);
    }
    check_accesses(unit);
  }

  void check_version(const Unit& unit, const Pass& member, const Access& access, const Location& at) {
    const std::string &expected = seen_[{&access, at}], &found = now_[at];
    if (kept_.contains(at) && kept_[at] != unit.pass)
      report(
          Hazard::lost_contents, &access, kept_[at]->name, member.name,
          "`" + member.name + "` reads `" + written_.resources[access.resource].name + "`, which kernel `" + kept_[at]->name + "` keeps to itself");
    if (expected != found)
      report(
          Hazard::wrong_version, &access, member.name, found,
          "`" + member.name + "` reads `" + written_.resources[access.resource].name + "` of `" + found + "`, and of `" + expected + "` as written");
  }

  // ---- one kernel

  void check_together(const Unit& unit) {
    const Pass& first = *unit.members.front();
    for (const Pass* member : unit.members) {
      const bool same = member->queue == first.queue && member->queue_may == first.queue_may && member->conditions == first.conditions &&
                        member->guard == first.guard && member->mip_limits == first.mip_limits && member->block && first.block &&
                        std::equal(member->dispatch.size, member->dispatch.size + 3, first.dispatch.size);
      if (!same) report(Hazard::invalid_plan, nullptr, first.name, member->name, "`" + first.name + "` and `" + member->name + "` do not run alike");
      for (const Pass* other : unit.members) {
        const bool both = member->block && other->block && member->block->scan != dsl::kAll && other->block->scan != dsl::kAll;
        if (both && member->block->scan != other->block->scan)
          report(Hazard::invalid_plan, nullptr, member->name, other->name,
                 "`" + member->name + "` and `" + other->name + "` scan along different axes");
      }
    }
  }

  // Elements must not meet but where both are the same.
  void check_apart(const Unit& unit) {
    for (size_t i = 0; i < unit.members.size(); ++i)
      for (size_t j = i + 1; j < unit.members.size(); ++j)
        for (const Access& a : unit.members[i]->accesses)
          for (const Access& b : unit.members[j]->accesses) check_pair(*unit.members[i], a, *unit.members[j], b);
  }

  void check_pair(const Pass& first, const Access& a, const Pass& second, const Access& b) {
    if (a.resource != b.resource || (!writes(a) && !writes(b))) return;
    const std::vector<Location> left = locations(written_, a), right = locations(written_, b);
    const bool meet =
        std::any_of(left.begin(), left.end(), [&](const Location& at) { return std::find(right.begin(), right.end(), at) != right.end(); });
    const bool alike = a.element && b.element && left == right && a.view == b.view;
    const bool commute = a.mode == Mode::atomic && b.mode == Mode::atomic;
    if (!meet || alike || commute) return;
    report(writes(a) ? Hazard::read_after_write : Hazard::write_after_read, &a, first.name, second.name,
           "`" + first.name + "` and `" + second.name + "` meet in `" + written_.resources[a.resource].name + "` at other elements than their own");
  }

  struct Rights {
    bool reads = false, writes = false, atomic = false;
  };
  using Table = std::map<Location, Rights>;

  void add(Table& table, const Access& access, bool inside) {
    for (const Location& at : locations(written_, access)) {
      Rights& rights = table[at];
      const bool own = inside && rights.writes && !rights.atomic;  // a member wrote it: it need not be read from memory
      rights.reads |= reads(access) && !own;
      rights.writes |= writes(access);
      rights.atomic |= access.mode == Mode::atomic;
    }
  }

  void check_accesses(const Unit& unit) {
    Table needed, declared;
    for (const Pass* member : unit.members)
      for (const Access& access : member->accesses) add(needed, access, unit.members.size() > 1);
    for (const Access& access : unit.pass->accesses) add(declared, access, false);
    for (const auto& [at, need] : needed) {
      const auto found = declared.find(at);
      const std::string& name = written_.resources.rows[std::get<0>(at)].name;
      if (found == declared.end()) {
        keep(unit, at, need, name);
      } else if ((need.reads && !found->second.reads) || need.writes != found->second.writes || need.atomic != found->second.atomic) {
        report(Hazard::invalid_plan, nullptr, unit.pass->name, "", "kernel `" + unit.pass->name + "` does not touch `" + name + "` as its blocks do");
      }
    }
    for (const auto& [at, has] : declared)
      if (!needed.contains(at))
        report(Hazard::invalid_plan, nullptr, unit.pass->name, "",
               "kernel `" + unit.pass->name + "` touches `" + written_.resources.rows[std::get<0>(at)].name + "`, which none of its blocks does");
  }

  // In registers: only what its members write before they read it, and what nobody needs afterwards.
  void keep(const Unit& unit, const Location& at, const Rights& need, const std::string& name) {
    const dsl::Resource& resource = written_.resources.rows[std::get<0>(at)];
    const bool lasts = resource.lifetime != dsl::Lifetime::transient || resource.is_output;
    if (need.reads || lasts || need.atomic || unit.members.size() == 1)
      report(Hazard::lost_contents, nullptr, unit.pass->name, "",
             "kernel `" + unit.pass->name + "` does not touch `" + name + "`, which its blocks do");
    kept_[at] = unit.pass;
  }

  void check_end() {
    for (const auto& [at, version] : last_) {
      const dsl::Resource& resource = written_.resources.rows[std::get<0>(at)];
      const bool lasts = resource.lifetime != dsl::Lifetime::transient || resource.is_output;
      if (lasts && now_[at] != version)
        report(Hazard::wrong_version, nullptr, version, now_[at],
               "`" + resource.name + "` ends as `" + now_[at] + "` left it, and as `" + version + "` did as written");
    }
  }

  const dsl::Graph &written_, &fused_;
  const std::vector<uint32_t>& configuration_;
  const std::vector<Kernel>& kernels_;
  std::vector<Unit> units_;
  std::map<std::pair<const Access*, Location>, std::string> seen_;  // what each read sees as written
  Versions last_, now_;                                             // as written, as planned
  std::map<Location, const Pass*> kept_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> verify_fusion(const dsl::Program& written, const dsl::Program& fused, dsl::GraphId graph,
                                   const std::vector<uint32_t>& configuration, const std::vector<Kernel>& kernels) {
  return Check(written.graphs[graph], fused.graphs[graph], configuration, kernels).run();
}

}  // namespace rg::verify
