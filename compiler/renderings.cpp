#include "compiler/renderings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "compiler/schedule_problem.h"

namespace rg::compiler {
namespace {

constexpr size_t kMostBetween = 4096;  // passes looked at for a way around a rendering

// What passes of one rendering have in common: role, views, resource, age, format, aspects, mip, layers, slices of each attachment, in order.
using Key = std::vector<std::array<uint32_t, 11>>;

Key key_of(const Frame& frame, const dsl::Pass& pass) {
  Key key;
  const auto add = [&](const dsl::Access& access, uint32_t role) {
    const Range range = resolved_range(frame.graph->resources[access.resource], access);
    key.push_back({role, pass.multiview, access.resource.value, access.age, static_cast<uint32_t>(access.view), range.aspects, range.mip, range.layer,
                   range.layers, access.range.slice, access.range.slices});
  };
  for (const dsl::Access& access : pass.accesses)
    if (access.role == dsl::Role::color) add(access, 0);
  for (const dsl::Access& access : pass.accesses) {
    if (access.role == dsl::Role::depth || access.role == dsl::Role::depth_readonly) add(access, 1);
    if (access.role == dsl::Role::stencil) add(access, 2);
  }
  return key;
}

template <class Rows, class Equal>
bool includes(const Rows& all, const Rows& some, Equal equal) {
  return std::all_of(some.begin(), some.end(),
                     [&](const auto& row) { return std::any_of(all.begin(), all.end(), [&](const auto& other) { return equal(row, other); }); });
}

// Whenever `later` runs, `first` does.
bool runs_with(const dsl::Pass& first, const dsl::Pass& later) {
  return includes(later.conditions, first.conditions, [](auto a, auto b) { return a == b; }) &&
         includes(later.mip_limits, first.mip_limits, [](const auto& a, const auto& b) { return a.image == b.image && a.mip <= b.mip; });
}

bool clears_some(const dsl::Pass& pass) {
  return std::any_of(pass.accesses.begin(), pass.accesses.end(), [](const dsl::Access& a) { return is_attachment(a.role) && a.clear; });
}
bool resolves(const dsl::Pass& pass) {
  return std::any_of(pass.transfers.begin(), pass.transfers.end(), [](const auto& t) { return t.kind == dsl::TransferKind::resolve; });
}

class Finder {
 public:
  Finder(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const PlanOptions& options, const std::vector<uint32_t>& apart)
      : frame_(frame),
        options_(options),
        live_(live),
        apart_(apart),
        before_(frame.passes.size()),
        result_(separate_renderings(frame)),
        members_(frame.passes.size()),
        seen_from_(frame.passes.size(), UINT32_MAX) {
    for (const Dependency& d : graph.dependencies) before_[d.after].push_back(&d);
  }

  Renderings run(const Graph& graph) {
    for (uint32_t pass = 0; pass < frame_.passes.size(); ++pass) {
      members_[pass] = {pass};
      if (live_[pass] && frame_.pass(pass).kind == dsl::PassKind::raster) consider(pass);
    }
    if (!links_.empty()) keep_free_links(graph);
    finish();
    return std::move(result_);
  }

 private:
  // Joins the pass to the last rendering with its attachments, if it can be.
  void consider(uint32_t pass) {
    const Key key = key_of(frame_, frame_.pass(pass));
    if (key.empty()) return;
    const auto [row, is_new] = last_.try_emplace(key, pass);
    if (is_new) return;
    const uint32_t leader = row->second;
    if (!attachments_.contains(leader)) remember(leader, leader);
    const std::string obstacle = obstacle_to(leader, pass);
    if (!obstacle.empty()) {
      note(pass, "not merged",
           fmt::format("a rendering of its own, though its attachments are those of `{}`: {}", name(members_[leader].back()), obstacle));
      row->second = pass;
      return;
    }
    remember(leader, pass);
    result_.leader_of[pass] = leader;
    members_[leader].push_back(pass);
    links_.push_back(pass);
  }

  // Empty, or why `pass` cannot follow in the rendering that `leader` begins, and what would change that.
  std::string obstacle_to(uint32_t leader, uint32_t pass) {
    const dsl::Pass &first = frame_.pass(leader), &row = frame_.pass(pass);
    const uint32_t last = members_[leader].back();
    if (std::binary_search(apart_.begin(), apart_.end(), pass))
      return "apart the frame needs less memory, which is worth the barriers; `--prefer barriers` weighs otherwise";
    for (const uint32_t one : {last, pass})
      if (options_.no_merge.contains(frame_.pass(one).name)) return fmt::format("`--no-merge={}`", name(one));
    if (const std::string fixed = fixed_between(leader, pass); !fixed.empty()) return fixed;
    if (first.queue != row.queue) return "they name different queues";
    if (row.multiview) return "queries within a rendering of several views count for each, so its passes could not be timed";
    if (clears_some(row)) return "it clears, which only the first pass of a rendering can; without `clear` it would continue";
    if (resolves(frame_.pass(last))) return fmt::format("`{}` resolves, which ends a rendering; a resolve in this pass would not", name(last));
    if (!runs_with(first, row)) return fmt::format("it may run where `{}` is skipped; under the same conditions it would continue", name(leader));
    if (const std::string other = other_dependency(leader, pass); !other.empty()) return other;
    if (const std::string feedback = layout_obstacle(leader, pass); !feedback.empty()) return feedback;
    return way_around(leader, pass);
  }

  // A pass that keeps its place parts what is not next to it.
  std::string fixed_between(uint32_t leader, uint32_t pass) const {
    if (options_.no_reorder.empty()) return {};
    size_t passes = 0;
    std::string fixed;
    for (uint32_t between = leader; between <= pass; ++between) {
      passes += live_[between];
      if (live_[between] && options_.no_reorder.contains(name(between))) fixed = name(between);
    }
    return fixed.empty() || passes == members_[leader].size() + 1 ? "" : fmt::format("`{}` keeps its place by `--no-reorder={}`", fixed, fixed);
  }

  // A dependency that is not through an attachment of both.
  std::string other_dependency(uint32_t leader, uint32_t pass) const {
    for (const Dependency* d : before_[pass]) {
      if (result_.leader_of[d->before] != leader || d->kind == DependencyKind::order) continue;
      if (!is_other(d->before, d->cell) && !is_other(pass, d->cell)) continue;
      return fmt::format("{} on `{}` with `{}` needs a barrier", compiler::name(d->kind), frame_.resource_of(d->cell).name, name(d->before));
    }
    return {};
  }
  // Touches the cell other than as an attachment.
  bool is_other(uint32_t pass, uint32_t cell) const {
    for (const dsl::Access& access : frame_.pass(pass).accesses) {
      if (is_attachment(access.role) || access.role == dsl::Role::resolve_src || access.resource.value != frame_.cells[cell].resource) continue;
      const std::vector<uint32_t> cells = cells_of(frame_, access);
      if (std::binary_search(cells.begin(), cells.end(), cell)) return true;
    }
    return false;
  }

  // Attachments of the passes in different layouts: one of them reads depth only. It can use the other's, unless it samples what it tests.
  std::string layout_obstacle(uint32_t leader, uint32_t pass) const {
    const auto found = attachments_.find(leader);
    if (found == attachments_.end()) return {};
    for (const AttachmentUse& use : attachment_uses(pass)) {
      const auto [begin, end] = found->second.equal_range(use.cell);
      for (auto row = begin; row != end; ++row) {
        const AttachmentUse& other = row->second;
        if (other.layout == use.layout) continue;
        const AttachmentUse& reader = use.writes ? other : use;
        if (use.writes == other.writes || reader.is_sampled)
          return fmt::format("`{}` also reads `{}` in a shader, which takes another layout", name(reader.pass), frame_.resource_of(use.cell).name);
      }
    }
    return {};
  }

  struct AttachmentUse {
    uint32_t cell = 0, pass = 0;
    size_t use = 0;  // of the frame
    Layout layout = Layout::undefined;
    bool writes = false, is_sampled = false;
    bool is_alike(const AttachmentUse& other) const { return layout == other.layout && writes == other.writes && is_sampled == other.is_sampled; }
  };
  std::vector<AttachmentUse> attachment_uses(uint32_t pass) const {
    std::vector<AttachmentUse> uses;
    for (size_t i = frame_.first_use[pass]; i < frame_.first_use[pass + 1]; ++i) {
      const Use& use = frame_.uses[i];
      uses.push_back({use.cell, pass, i, use.effect.layout, use.writes(), is_other(pass, use.cell)});
    }
    return uses;
  }
  // One of each kind is enough, so that a rendering of many passes is looked at once a pass.
  void remember(uint32_t leader, uint32_t pass) {
    std::multimap<uint32_t, AttachmentUse>& known = attachments_[leader];
    for (const AttachmentUse& use : attachment_uses(pass)) {
      const auto [begin, end] = known.equal_range(use.cell);
      if (std::none_of(begin, end, [&](const auto& row) { return row.second.is_alike(use); })) known.emplace(use.cell, use);
    }
  }

  // A pass outside that depends on the rendering and that `pass` depends on. Renderings count as a whole.
  std::string way_around(uint32_t leader, uint32_t pass) {
    std::vector<uint32_t> open{pass};
    for (size_t next = 0; next < open.size(); ++next) {
      if (open.size() > kMostBetween) return fmt::format("more than {} passes between them were not searched", kMostBetween);
      for (const uint32_t member : members_[result_.leader_of[open[next]]])
        for (const Dependency* d : before_[member]) {
          if (d->before < leader) continue;
          if (result_.leader_of[d->before] == leader) {
            if (open[next] == pass) continue;
            return fmt::format("`{}` has to run between them: {} with `{}`", name(d->after), compiler::name(d->kind), name(d->before));
          }
          if (seen_from_[d->before] == pass || d->before > pass) continue;
          seen_from_[d->before] = pass;
          open.push_back(d->before);
        }
    }
    return {};
  }

  // Merges that program order, cut greedily, pays for with memory are undone: all at once if none costs anything, else half by half.
  void keep_free_links(const Graph& graph) {
    const uint64_t limit = peak_in_program_order(graph, separate_renderings(frame_).leader_of);
    std::vector<uint32_t> kept;
    keep(graph, links_, kept, limit);
    for (const uint32_t link : links_)
      if (!std::binary_search(kept.begin(), kept.end(), link)) {
        const uint32_t leader = result_.leader_of[link];
        note(link, "not merged",
             fmt::format(
                 "a rendering of its own, though its attachments are those of `{}`: together their other resources would be live at once, which "
                 "takes more memory; `no alias` resources do not count",
                 name(leader)));
      }
    result_.leader_of = leaders_with(kept);
  }
  void keep(const Graph& graph, const std::vector<uint32_t>& links, std::vector<uint32_t>& kept, uint64_t limit) const {
    std::vector<uint32_t> tried = kept;
    tried.insert(tried.end(), links.begin(), links.end());
    if (peak_in_program_order(graph, leaders_with(tried)) <= limit) {
      kept = std::move(tried);
    } else if (links.size() > 1) {
      const auto middle = links.begin() + static_cast<std::ptrdiff_t>(links.size() / 2);
      keep(graph, {links.begin(), middle}, kept, limit);
      keep(graph, {middle, links.end()}, kept, limit);
    }
  }
  // A link joins a pass to the one before it in its rendering; `links` ascending.
  std::vector<uint32_t> leaders_with(const std::vector<uint32_t>& links) const {
    std::vector<uint32_t> leader_of = separate_renderings(frame_).leader_of;
    for (const uint32_t link : links) {
      const auto& members = members_[result_.leader_of[link]];
      leader_of[link] = leader_of[*(std::lower_bound(members.begin(), members.end(), link) - 1)];
    }
    return leader_of;
  }
  uint64_t peak_in_program_order(const Graph& graph, const std::vector<uint32_t>& leader_of) const {
    const ScheduleProblem problem = make_problem(frame_, graph, live_, leader_of, options_);
    return cost_of(problem.segments, program_order_segments(problem.segments)).peak;
  }

  void finish() {
    std::vector<uint32_t> previous(frame_.passes.size(), UINT32_MAX);
    for (uint32_t pass = 0; pass < frame_.passes.size(); ++pass) {
      const uint32_t leader = result_.leader_of[pass];
      if (leader != pass) {
        note(pass, "merged",
             fmt::format("continues the rendering of `{}`, whose attachments it shares: no barrier, no store and no load between them; with "
                         "`--no-merge={}` it would be one of its own",
                         name(previous[leader]), name(pass)));
      }
      previous[leader] = pass;
    }
    take_layouts();
  }
  // Who only reads an attachment takes the layout of those who write it in the same rendering.
  void take_layouts() {
    std::map<std::pair<uint32_t, uint32_t>, Layout> written;  // by leader and cell
    const auto each_use = [&](auto visit) {
      for (uint32_t pass = 0; pass < frame_.passes.size(); ++pass)
        if (frame_.pass(pass).kind == dsl::PassKind::raster)
          for (size_t use = frame_.first_use[pass]; use < frame_.first_use[pass + 1]; ++use) visit(result_.leader_of[pass], use, frame_.uses[use]);
    };
    each_use([&](uint32_t leader, size_t, const Use& use) {
      if (use.writes()) written[{leader, use.cell}] = use.effect.layout;
    });
    each_use([&](uint32_t leader, size_t index, const Use& use) {
      const auto row = written.find({leader, use.cell});
      if (!use.writes() && row != written.end() && row->second != use.effect.layout) result_.layouts.push_back({index, row->second});
    });
  }

  const std::string& name(uint32_t pass) const { return frame_.pass(pass).name; }
  void note(uint32_t pass, const char* what, std::string reason) { result_.decisions.push_back({name(pass), what, std::move(reason)}); }

  const Frame& frame_;
  const PlanOptions& options_;
  const std::vector<bool>& live_;
  const std::vector<uint32_t>& apart_;                  // passes that continue nothing
  std::vector<std::vector<const Dependency*>> before_;  // by pass
  Renderings result_;
  std::vector<std::vector<uint32_t>> members_;                              // by leader, ascending
  std::map<Key, uint32_t> last_;                                            // leader of the last rendering with these attachments
  std::vector<uint32_t> links_;                                             // passes that continue a rendering
  std::map<uint32_t, std::multimap<uint32_t, AttachmentUse>> attachments_;  // by leader and cell: one of each kind
  std::vector<uint32_t> seen_from_;                                         // by pass: the last search that came by
};

}  // namespace

Renderings separate_renderings(const Frame& frame) {
  Renderings result;
  result.leader_of.resize(frame.passes.size());
  std::iota(result.leader_of.begin(), result.leader_of.end(), 0u);
  return result;
}

Renderings find_renderings(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const PlanOptions& options,
                           const std::vector<uint32_t>& apart) {
  if (!options.merge) return separate_renderings(frame);
  return Finder(frame, graph, live, options, apart).run(graph);
}

}  // namespace rg::compiler
