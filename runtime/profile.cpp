#include "runtime/profile.h"

#include <algorithm>

#include "runtime/json_text.h"

namespace rg {

namespace {

std::string queue_name(const Plan& plan, Index queue) {
  static constexpr const char* kKinds[] = {"graphics", "compute", "transfer"};
  const auto kind = static_cast<size_t>(plan.queues[queue].kind);
  return std::to_string(queue) + " " + kKinds[std::min<size_t>(kind, 2)];
}

std::string statistics_json(const PassStatistics& s) {
  return "{\"vertices\": " + std::to_string(s.vertices) + ", \"vertex_invocations\": " + std::to_string(s.vertex_invocations) +
         ", \"primitives\": " + std::to_string(s.primitives) + ", \"fragment_invocations\": " + std::to_string(s.fragment_invocations) +
         ", \"compute_invocations\": " + std::to_string(s.compute_invocations) + "}";
}

}  // namespace

std::string profile_json(GraphInstance& graph) {
  std::string text = "{\n  \"schema\": \"rgc-profile-1\",\n  \"graph\": " + json_quoted(graph.plan().name) + ",\n  \"passes_us\": {";
  bool first = true;
  for (const PassTime& time : graph.pass_times()) {
    text += (first ? "\n    " : ",\n    ") + json_quoted(time.pass) + ": " + json_number(time.ms * 1000);
    first = false;
  }
  return text + "\n  }\n}\n";
}

void ChromeTrace::add(GraphInstance& graph) {
  if (!graph.wait_idle()) return;
  const Plan& plan = graph.plan();
  const std::vector<PassTime> times = graph.pass_times();
  const std::vector<PassStatistics> statistics = graph.pass_statistics();
  if (queues_.empty())
    for (Index queue = 0; queue < plan.queues.size(); ++queue) queues_.push_back(queue_name(plan, queue));
  const double start = frames_us_.back();
  double end = start;
  for (size_t i = 0; i < times.size(); ++i) {
    slices_.push_back({std::string(times[i].pass), std::string(plan.passes[i].module), plan.passes[i].queue, start + times[i].begin_ms * 1000,
                       times[i].ms * 1000, i < statistics.size() ? statistics[i] : PassStatistics{}});
    end = std::max(end, slices_.back().begin_us + slices_.back().duration_us);
  }
  frames_us_.push_back(end);
}

std::string ChromeTrace::json() const {
  std::string text = "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [\n";
  text += "{\"ph\": \"M\", \"pid\": 1, \"name\": \"process_name\", \"args\": {\"name\": \"GPU\"}}";
  for (size_t queue = 0; queue < queues_.size(); ++queue)
    text += ",\n{\"ph\": \"M\", \"pid\": 1, \"tid\": " + std::to_string(queue + 1) +
            ", \"name\": \"thread_name\", \"args\": {\"name\": " + json_quoted("queue " + queues_[queue]) + "}}";
  text += ",\n{\"ph\": \"M\", \"pid\": 1, \"tid\": 0, \"name\": \"thread_name\", \"args\": {\"name\": \"frames\"}}";
  for (size_t frame = 0; frame + 1 < frames_us_.size(); ++frame)
    text += ",\n{\"ph\": \"X\", \"pid\": 1, \"tid\": 0, \"name\": \"frame " + std::to_string(frame) +
            "\", \"ts\": " + json_number(frames_us_[frame]) + ", \"dur\": " + json_number(frames_us_[frame + 1] - frames_us_[frame]) + "}";
  for (const Slice& slice : slices_)
    text += ",\n{\"ph\": \"X\", \"pid\": 1, \"tid\": " + std::to_string(slice.queue + 1) + ", \"name\": " + json_quoted(slice.name) +
            ", \"cat\": " + json_quoted(slice.module.empty() ? "pass" : slice.module) + ", \"ts\": " + json_number(slice.begin_us) +
            ", \"dur\": " + json_number(slice.duration_us) + ", \"args\": " + statistics_json(slice.statistics) + "}";
  return text + "\n]}\n";
}

}  // namespace rg
