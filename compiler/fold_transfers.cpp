#include "compiler/fold_transfers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "compiler/access_table.h"
#include "compiler/configurations.h"
#include "compiler/cull.h"
#include "compiler/format_table.h"

namespace rg::compiler {
namespace {

using dsl::Access;
using dsl::PassKind;
using dsl::Role;
using dsl::TransferKind;

template <class Rows>
bool same_set(const Rows& a, const Rows& b) {
  const auto within = [](const Rows& some, const Rows& all) {
    return std::all_of(some.begin(), some.end(), [&](const auto& row) { return std::find(all.begin(), all.end(), row) != all.end(); });
  };
  return within(a, b) && within(b, a);
}

// Where a pass stands among those of one configuration, and whether anything needs it there.
struct Lives {
  Lives(const dsl::Program& program, dsl::GraphId graph, const PlanOptions& options, const std::vector<std::string>& fixed, size_t most_plans) {
    dsl::Diagnostics ignored;  // whoever compiles the plans asks again
    for (const Configuration& configuration : expand_configurations(program, graph, fixed, most_plans, ignored)) {
      const Frame frame = expand(program, graph, configuration, options);
      const Liveness liveness = cull(frame, build_graph(frame, std::vector<bool>(frame.passes.size(), true)));
      std::vector<bool>& live = in_plans.emplace_back(program.graphs[graph].passes.size());
      for (size_t i = 0; i < frame.passes.size(); ++i) live[frame.passes[i]] = liveness.live[i];
    }
  }
  bool alike(uint32_t a, uint32_t b) const {
    return std::all_of(in_plans.begin(), in_plans.end(), [&](const std::vector<bool>& live) { return live[a] == live[b]; });
  }
  std::vector<std::vector<bool>> in_plans;  // by configuration and pass of the program
};

class Folder {
 public:
  Folder(const dsl::Program& program, dsl::GraphId id, const PlanOptions& options, const std::vector<std::string>& fixed, size_t most_plans,
         FoldResult& result)
      : program_(program), graph_(program.graphs[id]), id_(id), options_(options), fixed_(fixed), most_plans_(most_plans), result_(result) {}

  // Nothing where every pass stays.
  std::optional<dsl::Graph> run() {
    std::vector<uint32_t> candidates;
    for (uint32_t p = 0; p < graph_.passes.size(); ++p)
      if (is_candidate(graph_.passes.rows[p])) candidates.push_back(p);
    if (candidates.empty() || !options_.fold) return std::nullopt;
    index();
    for (const uint32_t pass : candidates) consider(pass);
    if (edits_.empty()) return std::nullopt;
    return rewrite();
  }

 private:
  struct Touch {
    uint32_t pass = 0, access = 0;
  };
  struct Edit {
    uint32_t transfer = 0, into = 0;  // passes
    std::vector<uint32_t> cleared;    // accesses of `into`
    dsl::ClearValue value;
    uint32_t source = dsl::kAll;  // access of `into` that is resolved
    Access target;
  };

  static bool is_candidate(const dsl::Pass& pass) {
    return pass.kind == PassKind::transfer && !pass.transfers.empty() &&
           std::all_of(pass.transfers.begin(), pass.transfers.end(),
                       [](const dsl::Transfer& t) { return t.kind == TransferKind::clear || t.kind == TransferKind::resolve; });
  }

  void index() {
    touches_.resize(graph_.resources.size());
    for (uint32_t p = 0; p < graph_.passes.size(); ++p) {
      const dsl::Pass& pass = graph_.passes.rows[p];
      for (uint32_t a = 0; a < pass.accesses.size(); ++a) touches_[pass.accesses[a].resource.value].push_back({p, a});
      for (const dsl::PassId other : pass.after) named_.emplace(p, other.value), named_.emplace(other.value, p);
    }
  }

  void consider(uint32_t pass) {
    std::vector<Edit> edits;
    std::string obstacle = named_obstacle(pass);
    for (const dsl::Transfer& transfer : this->pass(pass).transfers) {
      if (!obstacle.empty()) break;
      Edit edit;
      edit.transfer = pass;
      obstacle = transfer.kind == TransferKind::clear ? clear_obstacle(transfer, edit) : resolve_obstacle(transfer, edits, edit);
      edits.push_back(std::move(edit));
    }
    if (!obstacle.empty()) return result_.refusals.push_back({id_, name(pass), std::move(obstacle)});
    Fold fold{id_, name(pass), {}};
    for (const Edit& edit : edits) {
      const bool clears = edit.source == dsl::kAll;
      const Access& drawn = this->pass(edit.into).accesses[clears ? edit.cleared.front() : edit.source];
      fold.parts.push_back({name(edit.into), image(drawn).name, clears ? "" : image(edit.target).name});
    }
    result_.folds.push_back(std::move(fold));
    gone_.insert(pass);
    edits_.insert(edits_.end(), std::make_move_iterator(edits.begin()), std::make_move_iterator(edits.end()));
  }

  // ---- why not; empty: it can be

  std::string named_obstacle(uint32_t p) const {
    const dsl::Pass& row = pass(p);
    if (options_.no_fold.contains(row.name)) return fmt::format("`--no-fold={}`", row.name);
    if (row.keep) return "`keep` holds it";
    if (const auto tied = named_.find(p); tied != named_.end()) return fmt::format("`after` ties it to `{}`", name(tied->second));
    for (const dsl::Assertion& assertion : graph_.assertions)
      for (const std::string& word : assertion.arguments)
        if (row.name == word || row.name.starts_with(word + "[")) return fmt::format("`{}` asks for it", assertion.text);
    return {};
  }

  std::string clear_obstacle(const dsl::Transfer& transfer, Edit& edit) const {
    const Access& cleared = pass(edit.transfer).accesses[transfer.dst];
    const std::string& name_of_image = image(cleared).name;
    if (const std::string own = own_obstacle(edit.transfer, transfer.dst); !own.empty()) return own;
    const Touch* next = next_touch(edit.transfer, cleared);
    if (next == nullptr) return fmt::format("no pass comes after it that draws to `{}`", name_of_image);
    edit.into = next->pass, edit.value = transfer.value;
    if (pass(edit.into).kind != PassKind::raster) return fmt::format("{} next, and only a rendering can begin so", use_text(*next));
    if (std::string apart = apart_obstacle(edit.transfer, edit.into); !apart.empty()) return apart;
    const Range all = resolved_range(image(cleared), cleared);
    uint32_t aspects = 0;
    for (uint32_t a = 0; a < pass(edit.into).accesses.size(); ++a) {
      const Access& access = pass(edit.into).accesses[a];
      if (!overlap(access, cleared)) continue;
      if (!is_attachment(access.role)) return fmt::format("{} otherwise than as an attachment", use_text({edit.into, a}));
      if (std::string why = drawn_obstacle(access, all, edit.into); !why.empty()) return why;
      if (access.mode == dsl::Mode::read) return fmt::format("{} only, and what is read only is not cleared", use_text({edit.into, a}));
      if (access.clear || !needs_contents(pass(edit.into), access))
        return fmt::format("`{}` defines all of `{}` itself", name(edit.into), name_of_image);
      aspects |= resolved_range(image(access), access).aspects;
      edit.cleared.push_back(a);
    }
    if (aspects != all.aspects) return fmt::format("it clears aspects of `{}` that `{}` does not draw to", name_of_image, name(edit.into));
    return {};
  }

  std::string resolve_obstacle(const dsl::Transfer& transfer, const std::vector<Edit>& earlier, Edit& edit) {
    const Access &from = pass(edit.transfer).accesses[transfer.src], &to = pass(edit.transfer).accesses[transfer.dst];
    for (const uint32_t own : {transfer.src, transfer.dst})
      if (std::string why = own_obstacle(edit.transfer, own); !why.empty()) return why;
    const FormatRow& format = format_row(image(from).format);
    if (format.integer || format.aspects != aspect_color)
      return fmt::format("which sample of `{}` stays is not the same everywhere", image(from).name);
    const Touch* writer = last_writer(edit.transfer, from);
    if (writer == nullptr) return fmt::format("no pass before it draws to `{}` in the frame", image(from).name);
    edit.into = writer->pass, edit.source = writer->access, edit.target = to;
    if (pass(edit.into).kind != PassKind::raster) return fmt::format("{} last, and only a rendering can end so", use_text(*writer));
    if (std::string apart = apart_obstacle(edit.transfer, edit.into); !apart.empty()) return apart;
    const Access& drawn = pass(edit.into).accesses[edit.source];
    if (drawn.role != Role::color) return fmt::format("{} last, not as an attachment", use_text(*writer));
    if (std::string why = drawn_obstacle(drawn, resolved_range(image(from), from), edit.into); !why.empty()) return why;
    if (std::string why = source_obstacle(edit, earlier); !why.empty()) return why;
    if (std::string why = target_obstacle(edit, from); !why.empty()) return why;
    if (!lives().alike(edit.transfer, edit.into)) return fmt::format("there are plans that need `{}` and not `{}`", name(edit.into), image(to).name);
    return {};
  }

  // Attachments are told apart by their image where a resolve names its source.
  std::string source_obstacle(const Edit& edit, const std::vector<Edit>& earlier) const {
    const dsl::Pass& row = pass(edit.into);
    const dsl::ResourceId source = row.accesses[edit.source].resource;
    const auto uses = std::count_if(row.accesses.begin(), row.accesses.end(), [&](const Access& access) { return access.resource == source; });
    if (uses != 1) return fmt::format("`{}` uses `{}` in several ways", row.name, graph_.resources[source].name);
    const auto same = [&](const Edit& other) {
      return other.into == edit.into && other.source != dsl::kAll && row.accesses[other.source].resource == source;
    };
    const bool declared =
        std::any_of(row.transfers.begin(), row.transfers.end(), [&](const dsl::Transfer& t) { return row.accesses[t.src].resource == source; });
    if (declared || std::any_of(edits_.begin(), edits_.end(), same) || std::any_of(earlier.begin(), earlier.end(), same))
      return fmt::format("`{}` resolves `{}` already", row.name, graph_.resources[source].name);
    return {};
  }

  std::string target_obstacle(const Edit& edit, const Access& from) const {
    const dsl::Resource &source = image(from), &target = image(edit.target);
    const Range a = resolved_range(source, from), b = resolved_range(target, edit.target);
    const bool same_size = source.width == target.width && source.height == target.height && a.mip == b.mip;
    if (!same_size || a.layers != b.layers || target.dimension == dsl::Dimension::d3)
      return fmt::format("`{}` and `{}` are not declared with one size", source.name, target.name);
    if (edit.target.view != dsl::Format::none) return fmt::format("`{}` is seen through a format that is not its own", target.name);
    const std::vector<Touch>& touches = touches_[edit.target.resource.value];
    const auto between = std::find_if(touches.begin(), touches.end(), [&](const Touch& touch) {
      return touch.pass >= edit.into && touch.pass < edit.transfer && overlap(access(touch), edit.target);
    });
    if (between != touches.end()) return fmt::format("{} before it, and after `{}` it would be another", use_text(*between), name(edit.into));
    const auto is_drawn = [&](const Touch& touch) { return access(touch).role == Role::color || access(touch).role == Role::resolve_dst; };
    const bool drawn =
        std::any_of(touches.begin(), touches.end(), [&](const Touch& t) { return pass(t.pass).kind == PassKind::raster && is_drawn(t); });
    if (target.lifetime == dsl::Lifetime::imported && !drawn)
      return fmt::format("no pass draws to `{}`, so that whoever brings it may not have made it an attachment", target.name);
    return {};
  }

  // The attachment against what the transfer touches.
  std::string drawn_obstacle(const Access& drawn, const Range& all, uint32_t into) const {
    const dsl::Resource& row = image(drawn);
    const Range range = resolved_range(row, drawn);
    if (range.mip != all.mip || range.mips != all.mips || range.layer != all.layer || range.layers != all.layers ||
        (range.aspects & ~all.aspects) != 0)
      return fmt::format("`{}` draws to another part of `{}`", name(into), row.name);
    if (row.dimension == dsl::Dimension::d3) return fmt::format("`{}` draws to slices of `{}`", name(into), row.name);
    if (drawn.view != dsl::Format::none && drawn.view != row.format)
      return fmt::format("`{}` sees `{}` through another format", name(into), row.name);
    return {};
  }

  // Another access of the transfer pass to the same texels.
  std::string own_obstacle(uint32_t p, uint32_t own) const {
    const std::vector<Access>& accesses = pass(p).accesses;
    for (uint32_t a = 0; a < accesses.size(); ++a)
      if (a != own && overlap(accesses[a], accesses[own])) return fmt::format("it touches `{}` twice", image(accesses[own]).name);
    return {};
  }

  // What keeps a transfer and a raster pass from being one.
  std::string apart_obstacle(uint32_t transfer, uint32_t raster) const {
    const dsl::Pass &a = pass(transfer), &b = pass(raster);
    if (options_.no_fold.contains(b.name)) return fmt::format("`--no-fold={}`", b.name);
    if (!same_set(a.guard.terms, b.guard.terms)) return fmt::format("`{}` is there with other features", b.name);
    if (!same_set(a.conditions, b.conditions) || !same_set(a.mip_limits, b.mip_limits))
      return fmt::format("`{}` runs under other conditions", b.name);
    if (a.queue != b.queue && !a.queue_may) return fmt::format("it names another queue than `{}`", b.name);
    return {};
  }

  // ---- looking around

  const dsl::Pass& pass(uint32_t p) const { return graph_.passes.rows[p]; }
  const std::string& name(uint32_t p) const { return pass(p).name; }
  const Access& access(const Touch& touch) const { return pass(touch.pass).accesses[touch.access]; }
  const dsl::Resource& image(const Access& access) const { return graph_.resources[access.resource]; }
  std::string use_text(const Touch& touch) const {
    const Access& row = access(touch);
    return fmt::format("`{}` {} `{}`", name(touch.pass),
                       row.mode == dsl::Mode::read ? "reads"
                       : is_attachment(row.role)   ? "draws to"
                                                   : "writes",
                       image(row).name);
  }

  bool overlap(const Access& a, const Access& b) const {
    if (a.resource != b.resource || a.age != b.age) return false;
    const Range x = resolved_range(image(a), a), y = resolved_range(image(b), b);
    const auto meet = [](uint32_t first, uint32_t count, uint32_t other, uint32_t other_count) {
      return first < other + other_count && other < first + count;
    };
    return (x.aspects & y.aspects) != 0 && meet(x.mip, x.mips, y.mip, y.mips) && meet(x.layer, x.layers, y.layer, y.layers);
  }

  const Touch* next_touch(uint32_t p, const Access& of) const {
    const std::vector<Touch>& touches = touches_[of.resource.value];
    const auto later = std::upper_bound(touches.begin(), touches.end(), p, [](uint32_t pass, const Touch& touch) { return pass < touch.pass; });
    const auto found = std::find_if(later, touches.end(), [&](const Touch& touch) { return overlap(access(touch), of); });
    return found == touches.end() ? nullptr : &*found;
  }
  const Touch* last_writer(uint32_t p, const Access& of) const {
    const std::vector<Touch>& touches = touches_[of.resource.value];
    const Touch* found = nullptr;
    for (const Touch& touch : touches)
      if (touch.pass < p && access(touch).mode != dsl::Mode::read && overlap(access(touch), of)) found = &touch;
    return found;
  }

  const Lives& lives() {
    if (!lives_) lives_.emplace(program_, id_, options_, fixed_, most_plans_);
    return *lives_;
  }

  // ---- the graph anew

  dsl::Graph rewrite() const {
    dsl::Graph out = graph_;
    for (const Edit& edit : edits_) apply(edit, out.passes.rows[edit.into]);
    std::vector<dsl::PassId> became(graph_.passes.size());
    std::vector<dsl::Pass> kept;
    for (uint32_t p = 0; p < out.passes.size(); ++p) {
      if (gone_.contains(p)) continue;
      became[p] = dsl::PassId{kept.size()};
      kept.push_back(std::move(out.passes.rows[p]));
    }
    out.passes.rows = std::move(kept);
    for (dsl::Pass& row : out.passes)
      for (dsl::PassId& other : row.after) other = became[other.value];  // none is gone: they would have been named
    for (dsl::Params& params : out.params)
      if (params.pass.valid()) params.pass = became[params.pass.value];
    return out;
  }
  static void apply(const Edit& edit, dsl::Pass& row) {
    for (const uint32_t a : edit.cleared) row.accesses[a].clear = edit.value, row.accesses[a].mode = dsl::Mode::write;
    if (edit.source == dsl::kAll) return;
    dsl::Transfer transfer;
    transfer.kind = TransferKind::resolve;
    transfer.src = edit.source, transfer.dst = static_cast<uint32_t>(row.accesses.size());
    row.accesses.push_back(edit.target);
    row.transfers.push_back(transfer);
  }

  const dsl::Program& program_;
  const dsl::Graph& graph_;
  dsl::GraphId id_;
  const PlanOptions& options_;
  const std::vector<std::string>& fixed_;
  size_t most_plans_;
  FoldResult& result_;
  std::vector<std::vector<Touch>> touches_;  // by resource, in program order
  std::map<uint32_t, uint32_t> named_;       // passes of an `after`, and one at its other end
  std::set<uint32_t> gone_;
  std::vector<Edit> edits_;
  std::optional<Lives> lives_;
};

std::string parts_text(const Fold& fold) {
  std::string text;
  for (const Fold::Part& part : fold.parts)
    text +=
        (text.empty() ? "" : "; ") + (part.target.empty() ? fmt::format("`{}` begins with `{}` cleared", part.into, part.image)
                                                          : fmt::format("`{}` ends with `{}` resolved to `{}`", part.into, part.image, part.target));
  return text;
}

}  // namespace

FoldResult fold_transfers(dsl::Program program, const PlanOptions& options, const std::vector<std::string>& fixed, size_t most_plans) {
  FoldResult result;
  for (size_t g = 0; g < program.graphs.size(); ++g) {
    const PlanOptions own = options_for(options, program.graphs.rows[g].name);
    if (auto graph = Folder(program, dsl::GraphId{g}, own, fixed, most_plans, result).run()) program.graphs.rows[g] = std::move(*graph);
  }
  result.program = std::move(program);
  return result;
}

Decisions fold_decisions(const std::vector<Fold>& folds, const std::vector<FoldRefusal>& refusals, dsl::GraphId graph) {
  Decisions decisions;
  for (const Fold& fold : folds) {
    if (fold.graph != graph) continue;
    decisions.push_back(
        {fold.pass, "folded",
         fmt::format("{}: no pass, barrier, load or store of its own; with `--no-fold={}` it would be one", parts_text(fold), fold.pass)});
    for (const Fold::Part& part : fold.parts)
      decisions.push_back(
          {part.into, part.target.empty() ? "clears" : "resolves", fmt::format("`{}`, in place of pass `{}`", part.image, fold.pass)});
  }
  for (const FoldRefusal& refusal : refusals)
    if (refusal.graph == graph) decisions.push_back({refusal.pass, "not folded", refusal.reason});
  return decisions;
}

}  // namespace rg::compiler
