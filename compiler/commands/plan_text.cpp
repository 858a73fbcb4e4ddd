#include "compiler/commands/plan_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/facts.h"

namespace rg::commands {
namespace {

template <class Barrier>
std::string scopes(const Barrier& barrier) {
  return fmt::format("{} {} -> {} {}", stage_names(barrier.src_stages), access_names(barrier.src_accesses), stage_names(barrier.dst_stages),
                     access_names(barrier.dst_accesses));
}

std::string ref_name(const PlanData& plan, Ref ref) {
  std::string name(plan.resources[ref.resource].name);
  return ref.age ? name + fmt::format(".prev({})", ref.age) : name;
}

std::string span_text(const char* what, uint32_t first, uint32_t count) {
  if (count == kRemaining) return first == 0 ? "" : fmt::format(" {} {}..", what, first);
  return count == 1 ? fmt::format(" {} {}", what, first) : fmt::format(" {}s {}..{}", what, first, first + count);
}

std::string range_text(const Range& range) { return span_text("mip", range.mip, range.mips) + span_text("layer", range.layer, range.layers); }

std::string layouts(const ImageBarrier& barrier) {
  if (barrier.old_layout == barrier.new_layout) return layout_name(barrier.new_layout);
  return layout_name(barrier.old_layout) + " -> " + layout_name(barrier.new_layout);
}

std::string tag_text(BarrierTag tag) { return tag == BarrierTag::hazard ? "" : "  (" + tag_name(tag) + ")"; }

struct Interval {
  size_t first = SIZE_MAX, last = 0;
  bool used() const { return first != SIZE_MAX; }
};

std::vector<Interval> intervals(const PlanData& plan) {
  std::vector<Interval> all(plan.resources.size());
  for (size_t p = 0; p < plan.passes.size(); ++p) {
    const Pass& pass = plan.passes[p];
    for (Index a = pass.first_access; a < pass.first_access + pass.access_count; ++a) {
      Interval& interval = all[plan.accesses[a].ref.resource];
      interval.first = std::min(interval.first, p);
      interval.last = std::max(interval.last, p);
    }
  }
  return all;
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string access_text(const dsl::Graph& graph, const dsl::Access& access) {
  std::string name = graph.resources[access.resource].name;
  if (access.age) name += fmt::format(".prev({})", access.age);
  if (access.range.mip || access.range.mips != dsl::kAll) name += span_text("mip", access.range.mip, access.range.mips);
  if (access.range.layer || access.range.layers != dsl::kAll) name += span_text("layer", access.range.layer, access.range.layers);
  return fmt::format("{} {} as {}", mode_name(access.mode), name, role_name(access.role));
}

std::string event_text(const BarrierGroup& group) { return group.event == kNone ? "" : fmt::format(" of event {}", group.event); }

// Where a split group begins.
std::string set_text(const PlanData& plan, const BarrierGroup& group) {
  std::string after = "at the start of its batch";
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass) after = fmt::format("after {}", plan.passes[step.index].name);
    if (step.kind == StepKind::set && plan.groups[step.index].event == group.event) break;
  }
  return fmt::format("event {}, set {}:", group.event, after);
}

}  // namespace

std::string barrier_group_text(const PlanData& plan, const BarrierGroup& group, const std::string& indent) {
  std::string text;
  if (group.event != kNone) text += fmt::format("{}{}\n", indent, set_text(plan, group));
  for (Index i = group.first_memory; i < group.first_memory + group.memory_count; ++i)
    text += fmt::format("{}memory  {}{}\n", indent, scopes(plan.memory_barriers[i]), tag_text(plan.memory_barriers[i].tag));
  for (Index i = group.first_image; i < group.first_image + group.image_count; ++i) {
    const ImageBarrier& barrier = plan.image_barriers[i];
    text += fmt::format("{}image   {}{}: {}, {}{}\n", indent, ref_name(plan, barrier.image), range_text(barrier.range), layouts(barrier),
                        scopes(barrier), tag_text(barrier.tag));
  }
  for (Index i = group.first_buffer; i < group.first_buffer + group.buffer_count; ++i) {
    const BufferBarrier& barrier = plan.buffer_barriers[i];
    text += fmt::format("{}buffer  {}: {}{}\n", indent, ref_name(plan, barrier.buffer), scopes(barrier), tag_text(barrier.tag));
  }
  return text;
}

std::string schedule_text(const PlanData& plan) {
  std::string text;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::pass)
      text += fmt::format("{:>4}  {}\n", step.index, plan.passes[step.index].name);
    else if (step.kind == StepKind::set)
      text += fmt::format("      -- set event {}\n", plan.groups[step.index].event);
    else if (const size_t count = barrier_count(plan.groups[step.index]))
      text += fmt::format("      -- {}{}\n", counted(count, "barrier"), event_text(plan.groups[step.index]));
  }
  for (const Culled& culled : plan.culled) text += fmt::format("   x  {}: {}\n", culled.pass, culled.reason);
  return text;
}

std::string lifetimes_text(const PlanData& plan) {
  std::string text;
  const std::vector<Interval> all = intervals(plan);
  for (size_t r = 0; r < all.size(); ++r) {
    if (!all[r].used()) continue;
    text += fmt::format("{:<32} [{:>3}, {:>3}]  {} .. {}\n", plan.resources[r].name, all[r].first, all[r].last, plan.passes[all[r].first].name,
                        plan.passes[all[r].last].name);
  }
  return text;
}

std::string memory_text(const PlanData& plan) {
  const std::vector<Interval> all = intervals(plan);
  std::vector<size_t> order;
  for (size_t r = 0; r < all.size(); ++r)
    if (all[r].used() && plan.resources[r].lifetime == Lifetime::transient) order.push_back(r);
  const auto key = [&](size_t r) { return std::pair(plan.resources[r].estimated_offset, all[r].first); };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::string text = fmt::format("heap {} bytes\n", plan.estimated_heap_bytes);
  for (const size_t r : order) {
    const Resource& resource = plan.resources[r];
    text += fmt::format("  [{:>12}, {:>12})  {:<32} live [{}, {}]\n", resource.estimated_offset, resource.estimated_offset + resource.estimated_bytes,
                        resource.name, all[r].first, all[r].last);
  }
  return text;
}

std::string barriers_text(const PlanData& plan) {
  std::string text, pending;
  for (const Step& step : plan.steps) {
    if (step.kind == StepKind::barriers) {
      pending += barrier_group_text(plan, plan.groups[step.index], "  ");
      continue;
    }
    if (step.kind == StepKind::set) continue;
    if (!pending.empty()) text += fmt::format("before {}\n{}", plan.passes[step.index].name, pending);
    pending.clear();
  }
  return pending.empty() ? text : text + "at the end\n" + pending;
}

std::string graph_text(const dsl::Program& program, const dsl::Graph& graph) {
  std::string text = fmt::format("graph {}\n", graph.name);
  for (const dsl::Resource& resource : graph.resources) text += fmt::format("  {} : {}\n", resource.name, resource_kind_text(program, resource));
  for (const dsl::Pass& pass : graph.passes) {
    text += fmt::format("  pass {}\n", pass.name);
    for (const dsl::Access& access : pass.accesses) text += fmt::format("    {}\n", access_text(graph, access));
  }
  return text;
}

std::string graph_dot(const dsl::Program& program, const compiler::CompiledGraph& compiled) {
  const dsl::Graph& graph = program.graphs[compiled.graph];
  const auto& culled = compiled.plans.front().plan.culled;
  std::string text = fmt::format("digraph {} {{\n  rankdir=LR;\n  node [fontname=\"sans\"];\n", in_quotes(graph.name));
  for (const dsl::Pass& pass : graph.passes) {
    const bool dead = std::any_of(culled.begin(), culled.end(), [&](const Culled& row) { return row.pass == pass.name; });
    text += fmt::format("  {} [shape=box{}];\n", in_quotes("pass " + pass.name), dead ? ", style=dashed" : "");
  }
  for (const dsl::Resource& resource : graph.resources) text += fmt::format("  {} [shape=ellipse];\n", in_quotes(resource.name));
  for (const dsl::Pass& pass : graph.passes) {
    for (const dsl::Access& access : pass.accesses) {
      const std::string resource = in_quotes(graph.resources[access.resource].name), box = in_quotes("pass " + pass.name);
      if (access.mode != dsl::Mode::write) text += fmt::format("  {} -> {}{};\n", resource, box, access.age ? " [style=dotted]" : "");
      if (access.mode != dsl::Mode::read) text += fmt::format("  {} -> {};\n", box, resource);
    }
  }
  return text + "}\n";
}

std::string place_text(const dsl::SourceFiles& sources, dsl::Span span) {
  if (!span.file.valid() || span.file.value >= sources.size()) return {};
  return fmt::format("{}:{}", sources[span.file].path, sources[span.file].position(span.begin).line);
}

std::string resource_kind_text(const dsl::Program& program, const dsl::Resource& resource) {
  const std::vector<int64_t> extents = dsl::initial_extents(program);
  const auto value = [&](dsl::ExprId id) { return id.valid() ? dsl::evaluate(program, id, extents) : 1; };
  constexpr const char* lifetimes[] = {"transient", "history", "persistent", "imported", "readback"};
  const char* lifetime = lifetimes[static_cast<size_t>(resource.lifetime)];
  if (resource.kind == dsl::ResourceKind::buffer) return fmt::format("{} buffer of {} x {} bytes", lifetime, value(resource.count), resource.stride);
  std::string size = fmt::format("{}x{}", value(resource.width), value(resource.height));
  if (resource.depth.valid() && resource.dimension == dsl::Dimension::d3) size += fmt::format("x{}", value(resource.depth));
  if (resource.layers > 1) size += fmt::format(" layers {}", resource.layers);
  if (resource.mips > 1) size += fmt::format(" mips {}", resource.mips);
  return fmt::format("{} image {} {}", lifetime, dsl::name(resource.format), size);
}

std::string mode_name(dsl::Mode mode) {
  constexpr const char* names[] = {"read", "write", "update", "atomic"};
  return names[static_cast<size_t>(mode)];
}

std::string role_name(dsl::Role role) {
  constexpr const char* names[] = {"sampled",        "storage",   "uniform",  "vertex",      "index",       "indirect",   "color",    "depth",
                                   "depth_readonly", "stencil",   "input",    "resolve_src", "resolve_dst", "copy_src",   "copy_dst", "blit_src",
                                   "blit_dst",       "clear_dst", "fill_dst", "update_dst",  "host_read",   "host_write", "present",  "undefined"};
  return names[static_cast<size_t>(role)];
}

}  // namespace rg::commands
