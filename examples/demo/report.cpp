#include "examples/demo/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rg::demo {
namespace {

double mib(uint64_t bytes) { return static_cast<double>(bytes) / (1024 * 1024); }

void add_passes(std::string& text, const Measurements& m) {
  double total = 0, longest = 0;
  for (const MeasuredPass& pass : m.passes) {
    total += pass.ms;
    longest = std::max(longest, pass.ms);
  }
  text += fmt::format("{:<24} {:>9}\n", "pass", "ms");
  for (const MeasuredPass& pass : m.passes) {
    const auto bar = static_cast<size_t>(longest > 0 ? 40 * pass.ms / longest : 0);
    text += fmt::format("{:<24} {:>9.3f}  {}\n", pass.name, pass.ms, std::string(bar, '='));
  }
  text += fmt::format("{:<24} {:>9.3f}   {} passes, each in its own submit\n", "sum", total, m.passes.size());
  text += fmt::format("{:<24} {:>9.3f}   one submit\n\n", "whole frame", m.frame_ms);
}

void add_memory(std::string& text, const MemoryReport& memory) {
  const double over =
      memory.lower_bound_bytes > 0 ? 100.0 * (static_cast<double>(memory.heap_bytes) / static_cast<double>(memory.lower_bound_bytes) - 1) : 0;
  const double saved =
      memory.unaliased_bytes > 0 ? 100.0 * (1 - static_cast<double>(memory.heap_bytes) / static_cast<double>(memory.unaliased_bytes)) : 0;
  text += "transient memory               MiB\n";
  text += fmt::format("{:<24} {:>9.2f}\n", "without aliasing", mib(memory.unaliased_bytes));
  text += fmt::format("{:<24} {:>9.2f}   {:.1f} % saved\n", "with aliasing", mib(memory.heap_bytes), saved);
  text += fmt::format("{:<24} {:>9.2f}   most bytes alive at once; {:.2f} % above it\n", "lower bound", mib(memory.lower_bound_bytes), over);
  text += fmt::format("{:<24} {:>9.2f}\n", "history, persistent", mib(memory.persistent_bytes));
  text += fmt::format("{:<24} {:>9.2f}\n\n", "shared with the host", mib(memory.host_bytes));
}

void add_barriers(std::string& text, const Plan& plan) {
  const auto counted = std::count_if(plan.groups.begin(), plan.groups.end(),
                                     [](const BarrierGroup& g) { return g.memory_count + g.image_count + g.buffer_count > 0; });
  text += fmt::format("barriers: {} calls with {} memory, {} image and {} buffer barriers\n", counted, plan.memory_barriers.size(),
                      plan.image_barriers.size(), plan.buffer_barriers.size());
  if (plan.culled.empty()) text += "culled passes: none, all of them reach an output\n";
  for (const Culled& culled : plan.culled) text += fmt::format("culled pass {}: {}\n", culled.pass, culled.reason);
}

}  // namespace

std::string format_report(const Plan& plan, const Measurements& m, const std::string& device) {
  std::string text = fmt::format("\n{}\n\n", device);
  add_passes(text, m);
  add_memory(text, m.memory);
  add_barriers(text, plan);
  text += fmt::format("culled meshes: {} of {} lie outside the view, {} are drawn ({} triangles), {} cast a shadow; {} lights\n", m.outside,
                      m.outside + m.visible, m.visible, m.triangles, m.in_sun, m.lights);
  return text;
}

}  // namespace rg::demo
