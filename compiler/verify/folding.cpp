#include "compiler/verify/folding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "compiler/verify/cells.h"
#include "compiler/verify/roles.h"

namespace rg::verify {
namespace {

using dsl::Access;
using dsl::Mode;
using dsl::Pass;
using dsl::Role;

// Resource, frames ago, aspect, mip, layer; buffers are one location.
using Location = std::array<uint32_t, 5>;
using Terms = std::map<Location, uint32_t>;
using Conditions = std::set<std::array<uint32_t, 3>>;

bool is_target(const Access& access) { return access.role == Role::color || access.role == Role::depth || access.role == Role::stencil; }
bool looks(const Access& access) { return access.mode != Mode::write; }

Conditions conditions_of(const Pass& pass) {
  Conditions all;
  for (const dsl::ConditionId id : pass.conditions) all.insert({0, id.value, 0});
  for (const dsl::MipLimit& limit : pass.mip_limits) all.insert({1, limit.image.value, limit.mip});
  return all;
}

// In a table, so that equal terms are one number.
class Language {
 public:
  uint32_t entry(const Location& at) { return number({0, at[0], at[1], at[2], at[3], at[4]}); }
  uint32_t pass(const std::string& name) {
    const auto row = names_.try_emplace(name, static_cast<uint32_t>(names_.size())).first;
    return number({1, row->second});
  }
  uint32_t clear(const dsl::ClearValue& value, uint32_t aspect) {
    if (aspect == 2) return number({2, aspect, std::bit_cast<uint32_t>(value.f[0])});
    if (aspect == 4) return number({2, aspect, value.u[1]});
    std::vector<uint32_t> row = {2, aspect, value.integer};
    for (size_t i = 0; i < 4; ++i) row.push_back(value.integer ? value.u[i] : std::bit_cast<uint32_t>(value.f[i]));
    return number(std::move(row));
  }
  uint32_t resolve(uint32_t source) { return number({3, source}); }
  uint32_t where(const Conditions& conditions, uint32_t then, uint32_t otherwise) {
    then = under(conditions, then), otherwise = unless(conditions, otherwise);
    if (conditions.empty() || then == otherwise) return then;
    std::vector<uint32_t> row = {4, then, otherwise};
    for (const auto& condition : conditions) row.insert(row.end(), condition.begin(), condition.end());
    return number(std::move(row));
  }
  // As a pass sees it that runs under these conditions.
  uint32_t under(const Conditions& conditions, uint32_t term) const {
    const std::vector<uint32_t>& row = rows_[term];
    if (row[0] != 4) return term;
    for (size_t i = 3; i < row.size(); i += 3)
      if (!conditions.contains({row[i], row[i + 1], row[i + 2]})) return term;
    return under(conditions, row[1]);
  }
  // As it is where one of them does not hold.
  uint32_t unless(const Conditions& conditions, uint32_t term) const {
    const std::vector<uint32_t>& row = rows_[term];
    if (row[0] != 4) return term;
    Conditions all;
    for (size_t i = 3; i < row.size(); i += 3) all.insert({row[i], row[i + 1], row[i + 2]});
    return std::includes(all.begin(), all.end(), conditions.begin(), conditions.end()) ? unless(conditions, row[2]) : term;
  }
  std::string text(uint32_t term) const {
    const std::vector<uint32_t>& row = rows_[term];
    if (row[0] == 0) return "what was there before the frame";
    if (row[0] == 2) return "a clear";
    if (row[0] == 3) return "a resolve of " + text(row[1]);
    if (row[0] == 4) return text(row[1]) + " under conditions";
    for (const auto& [name, number] : names_)
      if (number == row[1]) return "`" + name + "`";
    return "nobody";
  }

 private:
  uint32_t number(std::vector<uint32_t> row) {
    const auto [at, fresh] = numbers_.try_emplace(row, static_cast<uint32_t>(rows_.size()));
    if (fresh) rows_.push_back(std::move(row));
    return at->second;
  }
  std::map<std::vector<uint32_t>, uint32_t> numbers_;
  std::vector<std::vector<uint32_t>> rows_;
  std::map<std::string, uint32_t> names_;
};

// One program in order.
class Run {
 public:
  Run(const dsl::Graph& graph, Language& language) : graph_(graph), language_(language) {}

  std::vector<Location> locations(const Access& access) const {
    const dsl::Resource& row = graph_.resources[access.resource];
    if (row.kind == dsl::ResourceKind::buffer) return {{access.resource.value, access.age, 0, 0, 0}};
    const dsl::Range range = effective_range(access, aspects_of(row.format));
    const uint32_t mips = std::min(range.mips, row.mips - range.mip), layers = std::min(range.layers, row.layers - range.layer);
    std::vector<Location> all;
    for (uint32_t aspect = 1; aspect <= 4; aspect *= 2)
      for (uint32_t mip = 0; mip < mips && (range.aspects & aspect) != 0; ++mip)
        for (uint32_t layer = 0; layer < layers; ++layer)
          all.push_back({access.resource.value, access.age, aspect, range.mip + mip, range.layer + layer});
    return all;
  }

  // What the access finds, by location; nothing where it defines all.
  std::vector<uint32_t> found(const Pass& pass, const Access& access) {
    std::vector<uint32_t> terms;
    const bool cleared = is_target(access) && access.clear && access.range.slices == dsl::kAll;
    if (!cleared && !looks(access)) return terms;
    for (const Location& at : locations(access))
      terms.push_back(cleared ? language_.clear(*access.clear, at[2]) : language_.under(conditions_of(pass), term(at)));
    return terms;
  }

  void step(const Pass& pass) {
    const Conditions conditions = conditions_of(pass);
    const uint32_t own = language_.pass(pass.name);
    std::set<size_t> plain;  // accesses that clear or are resolved to
    for (const dsl::Transfer& transfer : pass.transfers)
      if (transfer.kind == dsl::TransferKind::clear || transfer.kind == dsl::TransferKind::resolve) plain.insert(transfer.dst);
    for (size_t a = 0; a < pass.accesses.size(); ++a)
      if (pass.accesses[a].mode != Mode::read && !plain.contains(a))
        for (const Location& at : locations(pass.accesses[a])) set(at, conditions, own);
    for (const dsl::Transfer& transfer : pass.transfers) {
      if (transfer.kind == dsl::TransferKind::clear)
        for (const Location& at : locations(pass.accesses[transfer.dst])) set(at, conditions, language_.clear(transfer.value, at[2]));
      if (transfer.kind == dsl::TransferKind::resolve) resolve(pass.accesses[transfer.src], pass.accesses[transfer.dst], conditions);
    }
  }

  uint32_t term(const Location& at) {
    const auto row = terms_.find(at);
    return row == terms_.end() ? language_.entry(at) : row->second;
  }
  const Terms& terms() const { return terms_; }

 private:
  void set(const Location& at, const Conditions& conditions, uint32_t now) { terms_[at] = language_.where(conditions, now, term(at)); }
  void resolve(const Access& from, const Access& to, const Conditions& conditions) {
    const std::vector<Location> sources = locations(from), targets = locations(to);
    for (size_t i = 0; i < targets.size(); ++i) {
      const uint32_t source = i < sources.size() ? language_.under(conditions, term(sources[i])) : language_.entry(targets[i]);
      set(targets[i], conditions, language_.resolve(source));
    }
  }

  const dsl::Graph& graph_;
  Language& language_;
  Terms terms_;
};

class Check {
 public:
  Check(const dsl::Graph& apart, const dsl::Graph& folded, const std::vector<uint32_t>& configuration)
      : apart_(apart), folded_(folded), configuration_(configuration), before_(apart, language_), after_(folded, language_) {}

  std::vector<Finding> run() {
    size_t next = 0;
    for (const Pass& pass : apart_.passes) {
      if (!is_selected(pass.guard, configuration_)) continue;
      while (next < folded_.passes.size() && !is_selected(folded_.passes.rows[next].guard, configuration_)) ++next;
      if (next < folded_.passes.size() && folded_.passes.rows[next].name == pass.name)
        compare(pass, folded_.passes.rows[next++]);
      else
        check_gone(pass);
      before_.step(pass);
    }
    for (; next < folded_.passes.size(); ++next)
      if (is_selected(folded_.passes.rows[next].guard, configuration_))
        report(Hazard::order, nullptr, folded_.passes.rows[next].name, "is not where it was");
    check_end();
    return std::move(findings_);
  }

 private:
  void report(Hazard hazard, const Access* access, const std::string& pass, const std::string& text) {
    const std::string image = access == nullptr ? "" : apart_.resources[access->resource].name;
    findings_.push_back({hazard, image, pass, "", "`" + pass + "` " + text});
  }

  void check_gone(const Pass& pass) {
    const bool plain =
        pass.kind == dsl::PassKind::transfer && std::all_of(pass.transfers.begin(), pass.transfers.end(), [](const dsl::Transfer& transfer) {
          return transfer.kind == dsl::TransferKind::clear || transfer.kind == dsl::TransferKind::resolve;
        });
    if (!plain) report(Hazard::missing_pass, nullptr, pass.name, "is gone, and does more than to clear and resolve");
    if (pass.keep) report(Hazard::missing_pass, nullptr, pass.name, "is gone, though it is to be kept");
    for (const dsl::PassId id : pass.after)
      report(Hazard::order, nullptr, pass.name, "is gone, though it comes `after` `" + apart_.passes[id].name + "`");
    if (pass.queue != dsl::QueueKind::graphics && !pass.queue_may)
      report(Hazard::submission, nullptr, pass.name, "is gone from the queue that it orders");
  }

  void compare(const Pass& a, const Pass& b) {
    check_rest(a, b);
    for (size_t i = 0; i < a.accesses.size() && i < b.accesses.size(); ++i) {
      const Access &x = a.accesses[i], &y = b.accesses[i];
      check_access(a, x, y);
      check_terms(a, x, before_.found(a, x), after_.found(b, y));
    }
    after_.step(b);
    if (a.accesses.size() > b.accesses.size()) report(Hazard::invalid_plan, nullptr, a.name, "lost an access");
    for (size_t i = a.transfers.size(); i < b.transfers.size(); ++i) check_resolve(b, b.transfers[i]);
  }

  void check_terms(const Pass& pass, const Access& access, const std::vector<uint32_t>& seen, const std::vector<uint32_t>& now) {
    size_t at = 0;
    while (at < seen.size() && at < now.size() && seen[at] == now[at]) ++at;
    if (at == seen.size() && at == now.size()) return;
    const auto text = [&](const std::vector<uint32_t>& terms) { return at < terms.size() ? language_.text(terms[at]) : std::string("nothing"); };
    report(Hazard::wrong_version, &access, pass.name,
           "sees " + text(now) + " in `" + apart_.resources[access.resource].name + "`, and " + text(seen) + " as written");
  }

  // All but accesses, and resolves at the end.
  void check_rest(const Pass& a, const Pass& b) {
    const auto rest = [](Pass pass) {
      pass.accesses.clear(), pass.transfers.clear(), pass.after.clear();
      return pass;
    };
    const bool prefix = a.transfers.size() <= b.transfers.size() && std::equal(a.transfers.begin(), a.transfers.end(), b.transfers.begin());
    if (rest(a) != rest(b) || !prefix) report(Hazard::invalid_plan, nullptr, a.name, "is another pass");
    const auto names = [](const dsl::Graph& graph, const Pass& pass) {
      std::set<std::string> all;
      for (const dsl::PassId id : pass.after) all.insert(graph.passes[id].name);
      return all;
    };
    if (names(apart_, a) != names(folded_, b)) report(Hazard::order, nullptr, a.name, "comes after other passes than as written");
  }

  void check_access(const Pass& pass, const Access& x, const Access& y) {
    Access same = x;
    same.stages = y.stages;  // known later
    const bool begins = is_target(x) && !x.clear && y.clear && x.mode == Mode::update && y.mode == Mode::write;
    if (begins) same.clear = y.clear, same.mode = y.mode;
    if (same != y) report(Hazard::invalid_plan, &x, pass.name, "uses `" + apart_.resources[x.resource].name + "` in another way");
    const dsl::Resource& image = apart_.resources[x.resource];
    const bool whole = x.range.slices == dsl::kAll && image.dimension != dsl::Dimension::d3;
    const bool own_format = x.view == dsl::Format::none || x.view == image.format;
    if (begins && !(whole && own_format))
      report(Hazard::invalid_plan, &x, pass.name, "clears part of `" + image.name + "`, or through another format");
  }

  void check_resolve(const Pass& pass, const dsl::Transfer& transfer) {
    if (pass.kind != dsl::PassKind::raster || transfer.kind != dsl::TransferKind::resolve)
      return report(Hazard::invalid_plan, nullptr, pass.name, "has a transfer that is no resolve of a rendering");
    const Access &from = pass.accesses.at(transfer.src), &to = pass.accesses.at(transfer.dst);
    const dsl::Resource &source = folded_.resources[from.resource], &target = folded_.resources[to.resource];
    const bool formats =
        source.format == target.format && to.view == dsl::Format::none && (from.view == dsl::Format::none || from.view == source.format);
    const bool sizes =
        source.width == target.width && source.height == target.height && from.range.mip == to.range.mip && source.samples > 1 && target.samples == 1;
    const bool roles = from.role == Role::color && to.role == Role::resolve_dst && to.mode == Mode::write && target.dimension != dsl::Dimension::d3;
    if (!formats || !sizes || !roles || after_.locations(from).size() != after_.locations(to).size())
      report(Hazard::invalid_plan, &from, pass.name, "cannot resolve `" + source.name + "` to `" + target.name + "`");
    if (is_integer(source.format))
      report(Hazard::invalid_plan, &from, pass.name, "resolves integers of `" + source.name + "`, of which commands keep any sample");
  }
  static bool is_integer(dsl::Format format) {
    const std::string name = dsl::name(format);
    return name.ends_with("ui") || name.ends_with("i");
  }

  void check_end() {
    std::set<Location> all;
    for (const auto* run : {&before_, &after_})
      for (const auto& [at, term] : run->terms()) all.insert(at);
    for (const Location& at : all) {
      const dsl::Resource& row = apart_.resources.rows[at[0]];
      const bool lasts = row.lifetime != dsl::Lifetime::transient || row.is_output;
      if (lasts && before_.term(at) != after_.term(at))
        findings_.push_back(
            {Hazard::wrong_version, row.name, "", "",
             "`" + row.name + "` ends as " + language_.text(after_.term(at)) + ", and as " + language_.text(before_.term(at)) + " as written"});
    }
  }

  const dsl::Graph &apart_, &folded_;
  const std::vector<uint32_t>& configuration_;
  Language language_;
  Run before_, after_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> verify_folding(const dsl::Program& apart, const dsl::Program& folded, dsl::GraphId graph,
                                    const std::vector<uint32_t>& configuration) {
  return Check(apart.graphs[graph], folded.graphs[graph], configuration).run();
}

}  // namespace rg::verify
