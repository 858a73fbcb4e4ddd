#include "compiler/judge_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "compiler/configurations.h"

namespace rg::compiler {
namespace {

constexpr size_t kShown = 3;

std::string bytes_text(uint64_t bytes) {
  constexpr double kKibi = 1024.0;
  const auto value = static_cast<double>(bytes);
  return value < kKibi * kKibi ? fmt::format("{:.1f} KiB", value / kKibi) : fmt::format("{:.1f} MiB", value / (kKibi * kKibi));
}

const dsl::Graph& graph_of(const Question& q) { return q.program.graphs[q.graph]; }

// `bloom_down` stands for every `bloom_down[i]`.
bool named(std::string_view name, const std::string& asked) {
  return name == asked || (name.starts_with(asked) && name.substr(asked.size(), 1) == "[");
}

struct Weighed {
  uint64_t weight = 0;
  Contributor contributor;
};

std::vector<Contributor> greatest(std::vector<Weighed> all) {
  std::erase_if(all, [](const Weighed& each) { return each.weight == 0; });
  std::stable_sort(all.begin(), all.end(), [](const Weighed& a, const Weighed& b) { return a.weight > b.weight; });
  if (all.size() > kShown) all.resize(kShown);
  std::vector<Contributor> rows;
  for (Weighed& each : all) rows.push_back(std::move(each.contributor));
  return rows;
}

dsl::Span resource_span(const Question& q, const PlanData& plan, size_t resource) {
  return resource < plan.program_resource.size() ? graph_of(q).resources.rows[plan.program_resource[resource]].span : dsl::Span{};
}
dsl::Span pass_span(const Question& q, const PlanData& plan, size_t pass) {
  return pass < plan.program_pass.size() ? graph_of(q).passes.rows[plan.program_pass[pass]].span : dsl::Span{};
}

// The worst plan by `measure`, and what `blame` says about it.
template <class Measure, class Blame>
Finding worst(const Question& q, Measure measure, Blame blame) {
  Finding finding;
  size_t at = 0;
  for (size_t i = 0; i < q.plans.size(); ++i) {
    const auto value = static_cast<double>(measure(q.plans[i], q.figures[i]));
    if (i == 0 || value > finding.value) finding.value = value, at = i;
  }
  if (q.plans.empty()) return finding;
  if (q.plans.size() > 1) finding.variant = q.plans[at].plan.variant_name;
  finding.contributors = blame(q.plans[at], q.figures[at]);
  return finding;
}

// ---- memory

// Of the transients alive together where most bytes are.
std::vector<Contributor> at_peak(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  uint64_t most = 0;
  uint32_t peak = 0;
  const auto alive = [](const ResourceFigures& row, uint32_t position) { return row.transient && row.first <= position && position <= row.last; };
  for (uint32_t position = 0; position < figures.passes.size(); ++position) {
    uint64_t live = 0;
    for (const ResourceFigures& row : figures.resources)
      if (alive(row, position)) live += row.bytes;
    if (live > most) most = live, peak = position;
  }
  std::vector<Weighed> all;
  for (size_t r = 0; r < figures.resources.size(); ++r)
    if (alive(figures.resources[r], peak))
      all.push_back(
          {figures.resources[r].bytes,
           {"`" + std::string(frame.plan.resources[r].name) + "`", bytes_text(figures.resources[r].bytes), resource_span(q, frame.plan, r)}});
  return greatest(std::move(all));
}

// The program as if its first extent were chosen as the assertion says.
dsl::Program at_extent(dsl::Program program, const dsl::Assertion& assertion) {
  if (program.extents.empty()) return program;
  dsl::Extent& extent = program.extents[dsl::ExtentId{0}];
  for (size_t axis = 0; axis < 3; ++axis)
    if (assertion.extent[axis]) extent.initial[axis] = *assertion.extent[axis];
  return program;
}

Finding heap(const Question& q) {
  Finding finding = worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.heap_bytes; },
      [&](const FramePlan& frame, const PlanFigures& figures) { return at_peak(q, frame, figures); });
  finding.bytes = true;
  return finding;
}

uint64_t bytes_of(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  uint64_t sum = 0;
  for (size_t r = 0; r < figures.resources.size(); ++r)
    if (named(frame.plan.resources[r].name, q.assertion.arguments[0])) sum += figures.resources[r].bytes;
  return sum;
}

std::vector<Contributor> named_resources(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  std::vector<Weighed> all;
  for (size_t r = 0; r < figures.resources.size(); ++r)
    if (named(frame.plan.resources[r].name, q.assertion.arguments[0]))
      all.push_back(
          {figures.resources[r].bytes,
           {"`" + std::string(frame.plan.resources[r].name) + "`", bytes_text(figures.resources[r].bytes), resource_span(q, frame.plan, r)}});
  return greatest(std::move(all));
}

Finding memory_now(const Question& q) {
  if (q.assertion.arguments.empty()) return heap(q);
  Finding finding = worst(
      q, [&](const FramePlan& frame, const PlanFigures& figures) { return bytes_of(q, frame, figures); },
      [&](const FramePlan& frame, const PlanFigures& figures) { return named_resources(q, frame, figures); });
  finding.bytes = true;
  return finding;
}

Finding memory(const Question& q) {
  if (!q.assertion.extent[0]) return memory_now(q);
  const dsl::Program resized = at_extent(q.program, q.assertion);
  std::vector<FramePlan> plans;
  std::vector<PlanFigures> figures;
  for (const FramePlan& plan : q.plans) {
    plans.push_back(plan_frame(resized, q.graph, plan.configuration, q.options));
    plans.back().plan.variant_name = plan.plan.variant_name;
    figures.push_back(find_figures(plans.back().plan));
  }
  return memory_now({resized, q.graph, plans, figures, q.options, q.assertion});
}

Finding unaliased(const Question& q) {
  Finding finding = worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.unaliased_bytes; },
      [&](const FramePlan& frame, const PlanFigures& figures) {
        std::vector<Weighed> all;
        for (size_t r = 0; r < figures.resources.size(); ++r)
          if (figures.resources[r].transient)
            all.push_back(
                {figures.resources[r].bytes,
                 {"`" + std::string(frame.plan.resources[r].name) + "`", bytes_text(figures.resources[r].bytes), resource_span(q, frame.plan, r)}});
        return greatest(std::move(all));
      });
  finding.bytes = true;
  return finding;
}

// ---- counts

template <class Count>
std::vector<Contributor> by_pass(const Question& q, const FramePlan& frame, const PlanFigures& figures, const char* noun, Count count) {
  std::vector<Weighed> all;
  for (size_t p = 0; p < figures.passes.size(); ++p) {
    const auto number = static_cast<uint64_t>(count(p));
    all.push_back({number, {"`" + std::string(frame.plan.passes[p].name) + "`", fmt::format("{} {}", number, noun), pass_span(q, frame.plan, p)}});
  }
  return greatest(std::move(all));
}

std::vector<Contributor> barriers_by_pass(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  return by_pass(q, frame, figures, "before it", [&](size_t p) {
    const bool asked = q.assertion.arguments.empty() || named(frame.plan.passes[p].name, q.assertion.arguments[0]);
    return asked ? figures.passes[p].barriers : 0;
  });
}

uint64_t barriers_in(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  if (q.assertion.arguments.empty()) return figures.barriers;
  uint64_t sum = 0;
  for (size_t p = 0; p < figures.passes.size(); ++p)
    if (named(frame.plan.passes[p].name, q.assertion.arguments[0])) sum += figures.passes[p].barriers;
  return sum;
}

Finding barriers(const Question& q) {
  return worst(
      q, [&](const FramePlan& frame, const PlanFigures& figures) { return barriers_in(q, frame, figures); },
      [&](const FramePlan& frame, const PlanFigures& figures) { return barriers_by_pass(q, frame, figures); });
}

Finding barrier_calls(const Question& q) {
  return worst(
      q, [](const FramePlan&, const PlanFigures& figures) { return figures.barrier_calls; },
      [&](const FramePlan& frame, const PlanFigures& figures) { return barriers_by_pass(q, frame, figures); });
}

// The passes that begin a batch, the first batch aside.
std::vector<Contributor> batch_heads(const Question& q, const FramePlan& frame, const PlanFigures& figures) {
  std::vector<uint32_t> first(frame.plan.batches.size(), kNone);
  for (uint32_t p = 0; p < figures.passes.size(); ++p) {
    const uint32_t batch = figures.passes[p].batch;
    if (batch < first.size() && (first[batch] == kNone || figures.passes[p].position < figures.passes[first[batch]].position)) first[batch] = p;
  }
  return by_pass(q, frame, figures, "waits where its submission begins", [&](size_t p) {
    const uint32_t batch = figures.passes[p].batch;
    return batch < first.size() && first[batch] == p ? frame.plan.batches[batch].wait_count + (batch > 0 ? 1u : 0u) : 0u;
  });
}

Finding submits(const Question& q) {
  return worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.plan.batches.size(); },
      [&](const FramePlan& frame, const PlanFigures& figures) { return batch_heads(q, frame, figures); });
}

Finding waits(const Question& q) {
  return worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.plan.waits.size(); },
      [&](const FramePlan& frame, const PlanFigures& figures) { return batch_heads(q, frame, figures); });
}

std::vector<Contributor> by_module(const FramePlan& frame) {
  std::map<std::string_view, uint64_t> counts;
  for (const Pass& pass : frame.plan.passes) ++counts[pass.module];
  std::vector<Weighed> all;
  for (const auto& [module, count] : counts) all.push_back({count, {"module `" + std::string(module) + "`", fmt::format("{} passes", count), {}}});
  return greatest(std::move(all));
}

Finding passes(const Question& q) {
  return worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.plan.passes.size(); },
      [](const FramePlan& frame, const PlanFigures&) { return by_module(frame); });
}

Finding culled(const Question& q) {
  return worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.plan.culled.size(); },
      [](const FramePlan& frame, const PlanFigures&) {
        std::vector<Weighed> all;
        for (const Culled& row : frame.plan.culled) all.push_back({1, {"`" + std::string(row.pass) + "`", std::string(row.reason), {}}});
        return greatest(std::move(all));
      });
}

Finding shaders(const Question& q) {
  return worst(
      q, [](const FramePlan& frame, const PlanFigures&) { return frame.plan.shaders.size(); },
      [](const FramePlan& frame, const PlanFigures&) {
        std::vector<Weighed> all;
        for (const ShaderModule& row : frame.plan.shaders)
          all.push_back({row.words.size(), {"`" + std::string(row.name) + "`", fmt::format("{} bytes of SPIR-V", row.words.size() * 4), {}}});
        return greatest(std::move(all));
      });
}

// ---- counters of shaders

// Of the shaders of the passes asked for, or of all, the one that has most; a shader that several passes share counts for the first.
template <uint32_t ShaderStatistics::*Count>
Finding counter(const Question& q) {
  const auto each = [&](const FramePlan& frame, auto visit) {
    const PlanData& plan = frame.plan;
    std::vector<bool> seen(plan.shaders.size());
    for (const Pipeline& pipeline : plan.pipelines) {
      if (!q.assertion.arguments.empty() && !named(plan.passes[pipeline.pass].name, q.assertion.arguments[0])) continue;
      for (Index i = pipeline.first_shader; i < pipeline.first_shader + pipeline.shader_count; ++i) {
        const Index shader = plan.pipeline_shaders[i];
        if (seen[shader]) continue;
        seen[shader] = true;
        const auto& words = plan.shaders[shader].words;
        visit(pipeline.pass, plan.shaders[shader], find_statistics({words.begin(), words.end()}).*Count);
      }
    }
  };
  const auto most = [&](const FramePlan& frame, const PlanFigures&) {
    uint32_t highest = 0;
    each(frame, [&](Index, const ShaderModule&, uint32_t count) { highest = std::max(highest, count); });
    return highest;
  };
  return worst(q, most, [&](const FramePlan& frame, const PlanFigures&) {
    std::vector<Weighed> all;
    each(frame, [&](Index pass, const ShaderModule& shader, uint32_t count) {
      all.push_back({count,
                     {"`" + std::string(shader.name) + "` of `" + std::string(frame.plan.passes[pass].name) + "`", std::to_string(count),
                      pass_span(q, frame.plan, pass)}});
    });
    return greatest(std::move(all));
  });
}

// Features multiply plans; those with most values first.
Finding variants(const Question& q) {
  Finding finding;
  finding.value = static_cast<double>(q.plans.size());
  std::vector<Weighed> all;
  for (size_t f = 0; f < q.program.features.size(); ++f) {
    std::vector<bool> seen(q.program.features.rows[f].values.size());
    for (const FramePlan& plan : q.plans)
      if (f < plan.configuration.size() && plan.configuration[f] < seen.size()) seen[plan.configuration[f]] = true;
    const auto count = static_cast<uint64_t>(std::count(seen.begin(), seen.end(), true));
    const dsl::Feature& feature = q.program.features.rows[f];
    if (count > 1) all.push_back({count, {"feature `" + feature.name + "`", fmt::format("{} values", count), feature.span}});
  }
  finding.contributors = greatest(std::move(all));
  return finding;
}

// ---- facts about named passes and resources

std::vector<uint32_t> find_passes(const FramePlan& frame, const std::string& name) {
  std::vector<uint32_t> found;
  for (uint32_t p = 0; p < frame.plan.passes.size(); ++p)
    if (named(frame.plan.passes[p].name, name)) found.push_back(p);
  return found;
}

std::vector<uint32_t> find_resources(const FramePlan& frame, const std::string& name) {
  std::vector<uint32_t> found;
  for (uint32_t r = 0; r < frame.plan.resources.size(); ++r)
    if (named(frame.plan.resources[r].name, name)) found.push_back(r);
  return found;
}

// Holds if every pair does, in every plan that has both.
template <class Find, class Holds, class Blame>
Finding every_pair(const Question& q, Find find, const char* otherwise, Holds holds, Blame blame) {
  Finding finding;
  finding.value = 1;
  for (size_t i = 0; i < q.plans.size(); ++i)
    for (const uint32_t a : find(q.plans[i], q.assertion.arguments[0]))
      for (const uint32_t b : find(q.plans[i], q.assertion.arguments[1])) {
        if (a == b || holds(q.figures[i], a, b)) continue;
        finding.value = 0;
        finding.verdict = otherwise;
        if (q.plans.size() > 1) finding.variant = q.plans[i].plan.variant_name;
        finding.contributors = blame(q.plans[i], q.figures[i], a, b);
        return finding;
      }
  return finding;
}

Contributor placed(const Question& q, const FramePlan& frame, const PlanFigures& figures, uint32_t pass) {
  const PassFigures& at = figures.passes[pass];
  return {"`" + std::string(frame.plan.passes[pass].name) + "`", fmt::format("place {} of {}", at.position + 1, figures.passes.size()),
          pass_span(q, frame.plan, pass)};
}

Finding order(const Question& q) {
  return every_pair(
      q, find_passes, "the other way round",
      [](const PlanFigures& figures, uint32_t a, uint32_t b) { return figures.passes[a].position < figures.passes[b].position; },
      [&](const FramePlan& frame, const PlanFigures& figures, uint32_t a, uint32_t b) {
        return std::vector<Contributor>{placed(q, frame, figures, a), placed(q, frame, figures, b)};
      });
}

// What the barriers between two passes of one queue are for: the passes they stand before.
std::vector<Contributor> between(const Question& q, const FramePlan& frame, const PlanFigures& figures, uint32_t a, uint32_t b) {
  const uint32_t from = std::min(figures.passes[a].position, figures.passes[b].position);
  const uint32_t to = std::max(figures.passes[a].position, figures.passes[b].position);
  return by_pass(q, frame, figures, "barriers before it", [&](size_t p) {
    const PassFigures& at = figures.passes[p];
    return at.position > from && at.position <= to ? at.barriers : 0u;
  });
}

// `on two_queues`: each runs on a queue of its own.
Finding overlaps(const Question& q) {
  const std::string on = q.assertion.fact.substr(std::string("overlaps").size());
  return every_pair(
      q, find_passes,
      on.empty()              ? "separated by a barrier"
      : on == " on one_queue" ? "separated by a barrier, or on two queues"
                              : "separated by a barrier, or on one queue",
      [&](const PlanFigures& figures, uint32_t a, uint32_t b) {
        const bool one_queue = figures.passes[a].queue == figures.passes[b].queue;
        return overlap(figures.passes[a], figures.passes[b]) && (on.empty() || one_queue == (on == " on one_queue"));
      },
      [&](const FramePlan& frame, const PlanFigures& figures, uint32_t a, uint32_t b) { return between(q, frame, figures, a, b); });
}

Finding aliases(const Question& q) {
  return every_pair(
      q, find_resources, "no byte shared",
      [](const PlanFigures& figures, uint32_t a, uint32_t b) { return share_bytes(figures.resources[a], figures.resources[b]); },
      [&](const FramePlan& frame, const PlanFigures& figures, uint32_t a, uint32_t b) {
        std::vector<Contributor> rows;
        for (const uint32_t r : {a, b}) {
          const ResourceFigures& at = figures.resources[r];
          const std::string where = at.transient ? fmt::format("bytes {} to {}", at.offset, at.offset + at.bytes) : std::string("memory of its own");
          rows.push_back({"`" + std::string(frame.plan.resources[r].name) + "`", where, resource_span(q, frame.plan, r)});
        }
        return rows;
      });
}

// Passes from the first use to the last, both included.
Finding lifetime(const Question& q) {
  const auto length = [](const ResourceFigures& row) { return row.first == kNone ? 0u : row.last - row.first + 1; };
  const auto longest = [&](const FramePlan& frame, const PlanFigures& figures) {
    uint32_t most = 0;
    for (const uint32_t r : find_resources(frame, q.assertion.arguments[0])) most = std::max(most, length(figures.resources[r]));
    return most;
  };
  return worst(q, longest, [&](const FramePlan& frame, const PlanFigures& figures) {
    std::vector<Contributor> rows;
    for (const uint32_t r : find_resources(frame, q.assertion.arguments[0])) {
      const ResourceFigures& at = figures.resources[r];
      if (length(at) != longest(frame, figures) || !rows.empty()) continue;
      for (uint32_t p = 0; p < figures.passes.size(); ++p)
        if (figures.passes[p].position == at.first || figures.passes[p].position == at.last)
          rows.push_back({"`" + std::string(frame.plan.passes[p].name) + "`", figures.passes[p].position == at.first ? "first use" : "last use",
                          pass_span(q, frame.plan, p)});
    }
    return rows;
  });
}

// Every pass of the name survives in every plan whose features select it.
Finding live(const Question& q) {
  Finding finding;
  finding.value = 1;
  for (const FramePlan& frame : q.plans)
    for (const Culled& row : frame.plan.culled) {
      if (!named(row.pass, q.assertion.arguments[0])) continue;
      finding.value = 0;
      finding.verdict = "culled";
      if (q.plans.size() > 1) finding.variant = frame.plan.variant_name;
      finding.contributors = {{"`" + std::string(row.pass) + "`", std::string(row.reason), {}}};
      return finding;
    }
  return finding;
}

// Runs on another queue than graphics, wherever it runs.
Finding async(const Question& q) {
  Finding finding;
  finding.value = 1;
  for (size_t i = 0; i < q.plans.size(); ++i)
    for (const uint32_t p : find_passes(q.plans[i], q.assertion.arguments[0])) {
      const uint32_t queue = q.figures[i].passes[p].queue;
      const auto& queues = q.plans[i].plan.queues;
      if (queue < queues.size() && queues[queue].kind != QueueKind::graphics) continue;
      finding.value = 0;
      finding.verdict = "on the graphics queue";
      if (q.plans.size() > 1) finding.variant = q.plans[i].plan.variant_name;
      finding.contributors = {placed(q, q.plans[i], q.figures[i], p)};
      return finding;
    }
  return finding;
}

}  // namespace

const std::vector<Fact>& known_facts() {
  static const std::vector<Fact> facts = {
      {"memory", "(WxH or RESOURCE)", 0, 1, true, memory},
      {"unaliased", "", 0, 0, true, unaliased},
      {"barriers", "(PASS)", 0, 1, true, barriers},
      {"barrier_calls", "", 0, 0, true, barrier_calls},
      {"submits", "", 0, 0, true, submits},
      {"waits", "", 0, 0, true, waits},
      {"passes", "", 0, 0, true, passes},
      {"culled", "", 0, 0, true, culled},
      {"shaders", "", 0, 0, true, shaders},
      {"variants", "", 0, 0, true, variants},
      {"instructions", "(PASS)", 0, 1, true, counter<&ShaderStatistics::instructions>},
      {"alu", "(PASS)", 0, 1, true, counter<&ShaderStatistics::alu>},
      {"samples", "(PASS)", 0, 1, true, counter<&ShaderStatistics::samples>},
      {"loads", "(PASS)", 0, 1, true, counter<&ShaderStatistics::loads>},
      {"stores", "(PASS)", 0, 1, true, counter<&ShaderStatistics::stores>},
      {"atomics", "(PASS)", 0, 1, true, counter<&ShaderStatistics::atomics>},
      {"branches", "(PASS)", 0, 1, true, counter<&ShaderStatistics::branches>},
      {"shared_bytes", "(PASS)", 0, 1, true, counter<&ShaderStatistics::shared_bytes>},
      {"live_scalars", "(PASS)", 0, 1, true, counter<&ShaderStatistics::live_scalars>},
      {"lifetime", "(RESOURCE)", 1, 1, true, lifetime},
      {"order", "(PASS, PASS)", 2, 2, false, order},
      {"overlaps", "(PASS, PASS)", 2, 2, false, overlaps},
      {"overlaps on one_queue", "", 2, 2, false, overlaps},
      {"overlaps on two_queues", "", 2, 2, false, overlaps},
      {"aliases", "(RESOURCE, RESOURCE)", 2, 2, false, aliases},
      {"live", "(PASS)", 1, 1, false, live},
      {"async", "(PASS)", 1, 1, false, async},
  };
  return facts;
}

}  // namespace rg::compiler
