#include "compiler/commands/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "compiler/configurations.h"
#include "compiler/pass_cost.h"

namespace rg::commands {
namespace {

struct BitName {
  uint64_t bit;
  const char* name;
};
constexpr BitName kStages[] = {{stage::draw_indirect, "DRAW_INDIRECT"},
                               {stage::index_input, "INDEX_INPUT"},
                               {stage::vertex_attribute_input, "VERTEX_ATTRIBUTE_INPUT"},
                               {stage::vertex_shader, "VERTEX_SHADER"},
                               {stage::tess_control_shader, "TESSELLATION_CONTROL_SHADER"},
                               {stage::tess_eval_shader, "TESSELLATION_EVALUATION_SHADER"},
                               {stage::geometry_shader, "GEOMETRY_SHADER"},
                               {stage::early_fragment_tests, "EARLY_FRAGMENT_TESTS"},
                               {stage::fragment_shader, "FRAGMENT_SHADER"},
                               {stage::late_fragment_tests, "LATE_FRAGMENT_TESTS"},
                               {stage::color_attachment_output, "COLOR_ATTACHMENT_OUTPUT"},
                               {stage::compute_shader, "COMPUTE_SHADER"},
                               {stage::all_transfer, "ALL_TRANSFER"},
                               {stage::copy, "COPY"},
                               {stage::resolve, "RESOLVE"},
                               {stage::blit, "BLIT"},
                               {stage::clear, "CLEAR"},
                               {stage::host, "HOST"},
                               {stage::bottom_of_pipe, "BOTTOM_OF_PIPE"},
                               {stage::all_graphics, "ALL_GRAPHICS"},
                               {stage::all_commands, "ALL_COMMANDS"}};
constexpr BitName kAccesses[] = {{access::indirect_command_read, "INDIRECT_COMMAND_READ"},
                                 {access::index_read, "INDEX_READ"},
                                 {access::vertex_attribute_read, "VERTEX_ATTRIBUTE_READ"},
                                 {access::uniform_read, "UNIFORM_READ"},
                                 {access::input_attachment_read, "INPUT_ATTACHMENT_READ"},
                                 {access::shader_read, "SHADER_READ"},
                                 {access::shader_write, "SHADER_WRITE"},
                                 {access::shader_sampled_read, "SHADER_SAMPLED_READ"},
                                 {access::shader_storage_read, "SHADER_STORAGE_READ"},
                                 {access::shader_storage_write, "SHADER_STORAGE_WRITE"},
                                 {access::color_attachment_read, "COLOR_ATTACHMENT_READ"},
                                 {access::color_attachment_write, "COLOR_ATTACHMENT_WRITE"},
                                 {access::depth_stencil_attachment_read, "DEPTH_STENCIL_ATTACHMENT_READ"},
                                 {access::depth_stencil_attachment_write, "DEPTH_STENCIL_ATTACHMENT_WRITE"},
                                 {access::transfer_read, "TRANSFER_READ"},
                                 {access::transfer_write, "TRANSFER_WRITE"},
                                 {access::host_read, "HOST_READ"},
                                 {access::host_write, "HOST_WRITE"},
                                 {access::memory_read, "MEMORY_READ"},
                                 {access::memory_write, "MEMORY_WRITE"}};

template <size_t n>
std::string bit_names(const BitName (&rows)[n], uint64_t bits) {
  std::string text;
  for (const BitName& row : rows)
    if (bits & row.bit) text += (text.empty() ? "" : "|") + std::string(row.name);
  return text.empty() ? "NONE" : text;
}

template <class Barrier>
bool is_blunt(const Barrier& barrier) {
  constexpr Stages stages = stage::all_commands | stage::all_graphics;
  constexpr Accesses accesses = access::memory_read | access::memory_write;
  return ((barrier.src_stages | barrier.dst_stages) & stages) || ((barrier.src_accesses | barrier.dst_accesses) & accesses);
}

size_t count_blunt(const PlanData& plan) {
  const auto count = [](const auto& barriers) { return std::count_if(barriers.begin(), barriers.end(), [](const auto& b) { return is_blunt(b); }); };
  return static_cast<size_t>(count(plan.memory_barriers) + count(plan.image_barriers) + count(plan.buffer_barriers));
}

void count_barriers(const PlanData& plan, Facts& facts) {
  for (const BarrierGroup& group : plan.groups) {
    facts.barriers += barrier_count(group);
    if (barrier_count(group)) ++facts.barrier_calls;
    facts.events += group.event != kNone;
  }
  facts.all_commands = count_blunt(plan);
  const auto add = [&](const auto& barriers) {
    for (const auto& b : barriers) {
      facts.barrier_stages += static_cast<size_t>(std::popcount(b.src_stages) + std::popcount(b.dst_stages));
      facts.barrier_accesses += static_cast<size_t>(std::popcount(b.src_accesses) + std::popcount(b.dst_accesses));
    }
  };
  add(plan.memory_barriers);
  add(plan.image_barriers);
  add(plan.buffer_barriers);
  facts.stall_us = static_cast<double>(facts.barrier_calls - facts.events) * compiler::kLaunchNs / 1000;
}

}  // namespace

size_t barrier_count(const BarrierGroup& group) { return size_t{group.memory_count} + group.image_count + group.buffer_count; }
std::string stage_names(Stages stages) { return bit_names(kStages, stages); }
std::string access_names(Accesses accesses) { return bit_names(kAccesses, accesses); }

std::string layout_name(Layout layout) {
  switch (layout) {
    case Layout::undefined:
      return "UNDEFINED";
    case Layout::general:
      return "GENERAL";
    case Layout::color_attachment:
      return "COLOR_ATTACHMENT";
    case Layout::depth_stencil_attachment:
      return "DEPTH_STENCIL_ATTACHMENT";
    case Layout::depth_stencil_read_only:
      return "DEPTH_STENCIL_READ_ONLY";
    case Layout::shader_read_only:
      return "SHADER_READ_ONLY";
    case Layout::transfer_src:
      return "TRANSFER_SRC";
    case Layout::transfer_dst:
      return "TRANSFER_DST";
    case Layout::depth_read_only_stencil_attachment:
      return "DEPTH_READ_ONLY_STENCIL_ATTACHMENT";
    case Layout::depth_attachment_stencil_read_only:
      return "DEPTH_ATTACHMENT_STENCIL_READ_ONLY";
    case Layout::depth_attachment:
      return "DEPTH_ATTACHMENT";
    case Layout::depth_read_only:
      return "DEPTH_READ_ONLY";
    case Layout::stencil_attachment:
      return "STENCIL_ATTACHMENT";
    case Layout::stencil_read_only:
      return "STENCIL_READ_ONLY";
    case Layout::present_src:
      return "PRESENT_SRC";
  }
  return "?";
}

std::string tag_name(BarrierTag tag) {
  constexpr const char* names[] = {"hazard", "valid usage", "workaround", "merged batch", "boundary join", "alias pair"};
  return names[static_cast<size_t>(tag)];
}

Facts find_facts(const dsl::Program& program, const compiler::CompiledGraph& graph, const compiler::FramePlan& plan) {
  Facts facts;
  facts.graph = program.graphs[graph.graph].name;
  facts.variant = compiler::configuration_name(program, plan.configuration);
  facts.passes_live = plan.plan.passes.size();
  facts.passes_culled = plan.plan.culled.size();
  facts.passes_raster =
      static_cast<size_t>(std::count_if(plan.plan.passes.begin(), plan.plan.passes.end(), [](const Pass& pass) { return pass.rendering != kNone; }));
  facts.renderings = plan.plan.renderings.size();
  facts.heap_bytes = plan.heap_bytes;
  facts.unaliased_bytes = plan.unaliased_bytes;
  facts.lower_bound_bytes = plan.lower_bound_bytes;
  facts.lazy_bytes = plan.lazy_bytes, facts.heap_beside_lazy_bytes = plan.heap_beside_lazy_bytes;
  count_barriers(plan.plan, facts);
  facts.submits = plan.plan.batches.size();
  facts.waits = plan.plan.waits.size();
  facts.signals = plan.plan.signals.size();
  facts.queues = plan.plan.queues.size();
  facts.overlap = plan.overlap, facts.order = plan.order;
  facts.plans = graph.plans.size();
  facts.shaders = graph.shaders.shaders.size();
  facts.phase_ms = plan.phase_ms;
  for (const auto& [phase, ms] : plan.phase_ms) facts.plan_ms += ms;
  return facts;
}

nlohmann::ordered_json to_json(const Facts& facts) {
  nlohmann::ordered_json phases = nlohmann::ordered_json::object();
  for (const auto& [phase, ms] : facts.phase_ms) phases[phase] = ms;
  nlohmann::ordered_json frontier = nlohmann::ordered_json::array(), work = nlohmann::ordered_json::array();
  for (const auto& point : facts.order.frontier) frontier.push_back({{"groups", point.groups}, {"bytes", point.bytes}});
  for (const double ns : facts.overlap.work) work.push_back(ns / 1000);
  return {
      {"graph", facts.graph},
      {"variant", facts.variant},
      {"passes", {{"live", facts.passes_live}, {"culled", facts.passes_culled}, {"raster", facts.passes_raster}, {"renderings", facts.renderings}}},
      {"memory",
       {{"heap_bytes", facts.heap_bytes},
        {"unaliased_bytes", facts.unaliased_bytes},
        {"lower_bound_bytes", facts.lower_bound_bytes},
        {"lazy_bytes", facts.lazy_bytes},
        {"heap_beside_lazy_bytes", facts.heap_beside_lazy_bytes}}},
      {"barriers",
       {{"calls", facts.barrier_calls},
        {"barriers", facts.barriers},
        {"events", facts.events},
        {"all_commands", facts.all_commands},
        {"stages", facts.barrier_stages},
        {"accesses", facts.barrier_accesses},
        {"stall_us", facts.stall_us}}},
      {"order",
       {{"method", facts.order.method},
        {"evaluations", facts.order.evaluations},
        {"ordered_pairs", facts.order.ordered_pairs},
        {"needed_pairs", facts.order.needed_pairs},
        {"frontier", frontier}}},
      {"queues", {{"count", facts.queues}, {"submits", facts.submits}, {"waits", facts.waits}, {"signals", facts.signals}}},
      {"overlap",
       {{"movable", facts.overlap.movable},
        {"moved", facts.overlap.moved},
        {"serial_us", facts.overlap.serial / 1000},
        {"critical_path_us", facts.overlap.critical_path / 1000},
        {"bound_us", facts.overlap.bound / 1000},
        {"modelled_us", facts.overlap.end / 1000},
        {"complete", facts.overlap.complete},
        {"work_us", work}}},
      {"variants", {{"plans", facts.plans}, {"shaders", facts.shaders}}},
      {"time_ms", {{"plan", facts.plan_ms}, {"phases", phases}}}};
}

}  // namespace rg::commands
