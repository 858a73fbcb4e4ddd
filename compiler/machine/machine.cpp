#include "compiler/machine/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

#include "compiler/machine/hand_offs.h"
#include "compiler/machine/memory.h"

namespace rg::machine {
namespace {

using Schedule = std::vector<uint32_t>;

struct Run {
  const Subject& subject;
  const Timeline& timeline;
  const Memory& start;
  std::vector<Divergence> found = {};

  bool full() const { return found.size() >= subject.options.max_divergences; }

  void report(Divergence divergence) {
    const bool known = std::any_of(found.begin(), found.end(),
                                   [&](const Divergence& each) { return each.pass == divergence.pass && each.resource == divergence.resource; });
    if (!known && !full()) found.push_back(std::move(divergence));
  }

  bool touches(const Event& event, uint32_t cell) const {
    if (event.resource == kNone) return true;
    const auto in = [&](uint32_t each) { return std::find(event.cells.begin(), event.cells.end(), each) != event.cells.end(); };
    return in(cell) || std::any_of(subject.cells.rivals[cell].begin(), subject.cells.rivals[cell].end(), in);
  }

  // The last events before `end` that touch the cell.
  std::string text_of(const Schedule& schedule, Caches caches, uint32_t cell, size_t end) const {
    std::vector<std::string> labels;
    for (size_t at = end; at-- > 0 && labels.size() < 8;)
      if (touches(timeline.events[schedule[at]], cell)) labels.insert(labels.begin(), timeline.events[schedule[at]].label);
    return fmt::format("{}: {}", caches == Caches::hoard ? "caches write back late and keep old lines" : "no caches", fmt::join(labels, "; "));
  }

  void report_read(const Mismatch& mismatch, const Schedule& schedule, Caches caches) {
    const Event& event = timeline.events[mismatch.event];
    const std::string pass = event.pass == kNone ? "" : subject.graph.passes.rows[subject.program_pass[event.pass]].name;
    const size_t end = static_cast<size_t>(std::find(schedule.begin(), schedule.end(), mismatch.event) - schedule.begin()) + 1;
    report({pass, subject.graph.resources.rows[event.resource].name, event.frame, subject.reference.name(mismatch.expected),
            subject.reference.name(mismatch.found), text_of(schedule, caches, mismatch.cell, end)});
  }

  bool observable(uint32_t resource, uint32_t piece) const {
    if (subject.graph.resources.rows[resource].is_output) return subject.graph.resources.rows[resource].lifetime != dsl::Lifetime::imported;
    for (const Boundary& boundary : subject.plan.exit) {
      if (subject.program_resource[boundary.ref.resource] != resource || boundary.ref.age != 0 || boundary.discard) continue;
      const dsl::Lifetime lifetime = subject.graph.resources.rows[resource].lifetime;
      if (lifetime != dsl::Lifetime::history && lifetime != dsl::Lifetime::persistent) continue;
      const ResourceCells& cells = subject.cells.resources[resource];
      const Pieces pieces = pieces_in(cells, region_of(subject.plan, subject.cells, cells, boundary));
      if (std::find(pieces.begin(), pieces.end(), piece) != pieces.end()) return true;
    }
    return false;
  }

  void compare_end(Memory& memory, const Schedule& schedule, Caches caches) {
    write_back(memory, subject.cells, static_cast<uint32_t>(timeline.events.size()));
    const uint32_t last = subject.options.frames - 1;
    for (uint32_t r = 0; r < subject.cells.resources.size(); ++r) {
      const ResourceCells& resource = subject.cells.resources[r];
      for (uint32_t piece = 0; piece < resource.pieces.size() && resource.exists; ++piece) {
        const uint32_t cell = physical_cell(resource, piece, 0, last);
        const Version expected = subject.reference.finals[last][r][piece], found = memory.contents[cell];
        if (expected == found || expected.base == version::undefined || !observable(r, piece)) continue;
        report({"", subject.graph.resources.rows[r].name, last, subject.reference.name(expected), subject.reference.name(found),
                text_of(schedule, caches, cell, schedule.size())});
      }
    }
  }

  void run(const Schedule& schedule) {
    for (const Caches caches : {Caches::none, Caches::hoard}) {
      Memory memory = start;
      for (const uint32_t event : schedule) execute(memory, subject.cells, timeline, event, caches);
      for (const Mismatch& mismatch : memory.mismatches) report_read(mismatch, schedule, caches);
      compare_end(memory, schedule, caches);
    }
  }
};

// For each event itself and all that must precede it, as bits. O(predecessors * events / 64).
class Closures {
 public:
  explicit Closures(const Predecessors& predecessors) : words_((predecessors.size() + 63) / 64), bits_(predecessors.size() * words_) {
    for (uint32_t e = 0; e < predecessors.size(); ++e) {
      for (size_t i = predecessors[e].size(); i-- > 0;)  // the latest imply most of the others
        if (const uint32_t before = predecessors[e][i]; !has(e, before)) join(e, before);
      bits_[e * words_ + e / 64] |= uint64_t{1} << (e % 64);
    }
  }
  bool has(uint32_t event, uint32_t before) const { return bits_[event * words_ + before / 64] >> (before % 64) & 1; }
  void join(uint32_t event, uint32_t before) {
    for (size_t w = 0; w <= before / 64; ++w) bits_[event * words_ + w] |= bits_[before * words_ + w];
  }
  // Everything submitted before the event.
  bool is_all(uint32_t event) const {
    uint32_t count = 0;
    for (size_t w = 0; w < words_; ++w) count += static_cast<uint32_t>(std::popcount(bits_[event * words_ + w]));
    return count == event + 1;
  }

 private:
  size_t words_;
  std::vector<uint64_t> bits_;
};

// `event` and all that must precede it, then the rest; each part in submission order.
Schedule as_early_as_possible(const Closures& closures, uint32_t events, uint32_t event) {
  Schedule schedule;
  for (const bool part : {true, false})
    for (uint32_t e = 0; e < events; ++e)
      if (closures.has(event, e) == part) schedule.push_back(e);
  return schedule;
}

// Visits linear extensions, at most `limit`.
void for_all_schedules(const Predecessors& predecessors, size_t limit, const std::function<bool(const Schedule&)>& visit) {
  Schedule schedule;
  std::vector<bool> done(predecessors.size());
  size_t count = 0;
  bool more = true;
  const std::function<void()> extend = [&] {
    if (schedule.size() == predecessors.size()) {
      more = visit(schedule) && ++count < limit;
      return;
    }
    for (uint32_t e = 0; e < predecessors.size() && more; ++e) {
      if (done[e] || !std::all_of(predecessors[e].begin(), predecessors[e].end(), [&](uint32_t before) { return done[before]; })) continue;
      done[e] = true;
      schedule.push_back(e);
      extend();
      schedule.pop_back();
      done[e] = false;
    }
  };
  extend();
}

// Events that everything submitted before must precede come no earlier than in submission order, which is run once for all of them.
void run_directed(Run& run, const Predecessors& predecessors) {
  const auto events = static_cast<uint32_t>(predecessors.size());
  const Closures closures(predecessors);
  Schedule in_order(events);
  std::iota(in_order.begin(), in_order.end(), 0u);
  run.run(in_order);
  for (uint32_t event = 0; event < events && !run.full(); ++event)
    if (!closures.is_all(event)) run.run(as_early_as_possible(closures, events, event));
}

void run_exhaustively(Run& run, const Predecessors& predecessors) {
  for_all_schedules(predecessors, run.subject.options.exhaustive_schedules, [&](const Schedule& schedule) {
    run.run(schedule);
    return !run.full();
  });
}

struct Question {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const std::vector<uint32_t>& configuration;
  const Plan& plan;
  const std::vector<uint32_t>& program_pass;
  const std::vector<uint32_t>& program_resource;
};

std::vector<Divergence> answer(const Question& question, const MachineOptions& options, void (*run_schedules)(Run&, const Predecessors&)) {
  const auto& [program, graph, configuration, plan, program_pass, program_resource] = question;
  const Cells cells = make_cells(program, graph, plan, program_resource, options);
  const Reference reference = run_in_order(program, graph, configuration, cells, options);
  const Subject subject{program, graph, plan, program_pass, program_resource, options, cells, reference};
  const Timeline timeline = unroll(subject);
  const Memory start = initial_memory(subject, timeline);
  Run run{subject, timeline, start};
  run_schedules(run, find_order(timeline));
  return std::move(run.found);
}

}  // namespace

std::string text(const Divergence& divergence) {
  const std::string who = divergence.pass.empty() ? "the observer" : "`" + divergence.pass + "`";
  return fmt::format("{} finds {} in `{}` where program order gives {} (frame {}); {}", who, divergence.found, divergence.resource,
                     divergence.expected, divergence.frame, divergence.schedule);
}

std::vector<Divergence> run_adversarially(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration,
                                          const Plan& plan, const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource,
                                          const MachineOptions& options) {
  const PatchedPlan patched(plan, options.placement);
  const Question question{program, program.graphs[graph], configuration, patched.plan(), program_pass, program_resource};
  MachineOptions enough_frames = options;  // every copy of a history is overwritten once
  for (const dsl::Resource& resource : question.graph.resources)
    if (resource.history > 0) enough_frames.frames = std::max(enough_frames.frames, resource.history + 2);
  std::vector<Divergence> found = answer(question, enough_frames, run_directed);
  size_t commands = 0;
  for (const Batch& batch : plan.batches) commands += batch.step_count;
  if (!found.empty() || commands > options.exhaustive_commands) return found;
  MachineOptions one_frame = options;
  one_frame.frames = 1;
  return answer(question, one_frame, run_exhaustively);
}

}  // namespace rg::machine
