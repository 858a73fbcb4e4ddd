#include "compiler/epochs.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

bool joins(const Epoch& epoch, const Use& use) {
  if (epoch.effect.layout != use.effect.layout) return false;
  if (!epoch.writes && !use.writes()) return true;
  return epoch.writes && use.writes() && use.share != Share::none && use.share == epoch.share;
}

// Host writes happen before the submit, which makes them visible to everything: nothing to wait for on the GPU.
Effect gpu_effect(const Effect& effect) {
  Effect result = effect;
  if (result.writes == access::host_write) result.writes = 0, result.write_stages = 0;
  return result;
}

// What a rendering does to a cell, or a pass that is alone: `uses` are those of its passes. Contents that the first does not need come from within.
struct Common {
  Use use;
  std::vector<const Use*> uses;
};
Common common_use(std::span<const Use* const>::iterator first, std::span<const Use* const>::iterator last) {
  Common common{**first, {first, last}};
  for (++first; first != last; ++first) {
    Effect effect = (*first)->effect;
    if (common.use.writes() && !common.use.needs) effect.reads = 0, effect.read_stages = 0;
    merge(common.use.effect, effect);
    if ((*first)->share != common.use.share) common.use.share = Share::none;
    if (!common.use.writes()) common.use.needs = common.use.needs || (*first)->needs;
  }
  return common;
}

void add(std::vector<Epoch>& epochs, uint32_t age, const Common& common, const Schedule& schedule) {
  const Use& use = common.use;
  const uint32_t segment = schedule.segment_of[use.pass], queue = schedule.queue_of_pass(use.pass);
  if (epochs.empty() || epochs.back().age != age || !joins(epochs.back(), use)) {
    Epoch epoch;
    epoch.age = age, epoch.first_segment = segment, epoch.share = use.share, epoch.writes = use.writes(), epoch.effect.layout = use.effect.layout,
    epoch.queue = queue;
    epochs.push_back(epoch);
  }
  Epoch& epoch = epochs.back();
  RG_CHECK(segment >= epoch.last_segment, "uses arrive in schedule order");
  merge(epoch.effect, gpu_effect(use.effect));
  epoch.last_segment = segment;
  if (epoch.queue != queue) epoch.queue = kSeveralQueues;
  epoch.needs = epoch.needs || use.needs;
  for (const Use* each : common.uses) {
    Effect effect = gpu_effect(each->effect);
    if (each != common.uses.front() && use.writes() && !use.needs) effect.reads = 0, effect.read_stages = 0;
    epoch.events.push_back({segment, effect.stages(), each->pass, effect.read_stages, effect.reads, false, queue, effect});
  }
}

void add_rows(std::vector<Epoch>& epochs, uint32_t age, std::span<const Use* const> uses, const Schedule& schedule) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first + 1;
    while (last != uses.end() && schedule.leader_of[(*last)->pass] == schedule.leader_of[(*first)->pass]) ++last;
    add(epochs, age, common_use(first, last), schedule);
    first = last;
  }
}

// In the order of the schedule, cell after cell.
class UsesOfCells {
 public:
  UsesOfCells(const Frame& frame, const Schedule& schedule) : first_(frame.cells.size() + 1) {
    for (const uint32_t pass : schedule.order)
      for (const Use& use : frame.uses_of(pass)) ++first_[use.cell + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    uses_.resize(first_.back());
    for (const uint32_t pass : schedule.order)
      for (const Use& use : frame.uses_of(pass)) uses_[next[use.cell]++] = &use;
  }
  std::span<const Use* const> of(uint32_t cell) const { return {uses_.data() + first_[cell], first_[cell + 1] - first_[cell]}; }

 private:
  std::vector<uint32_t> first_;
  std::vector<const Use*> uses_;
};

bool crosses_frames(dsl::Lifetime lifetime) { return lifetime == dsl::Lifetime::history || lifetime == dsl::Lifetime::persistent; }

// Backwards over the boundary, so that a chain of reads over several ages is covered from its start.
void cover_continued_reads(Line& line) {
  auto& epochs = line.epochs;
  for (Epoch& epoch : epochs) epoch.covered = epoch.effect;
  const size_t n = epochs.size();
  for (size_t round = 0; round < 2; ++round)
    for (size_t i = n; i-- > 0;)
      if (continues(epochs[i], epochs[(i + 1) % n])) merge(epochs[i].covered, epochs[(i + 1) % n].covered);
}

}  // namespace

void merge(Effect& effect, const Effect& other) {
  RG_CHECK(effect.layout == other.layout, "uses of one epoch agree on the layout");
  effect.read_stages |= other.read_stages, effect.write_stages |= other.write_stages;
  effect.reads |= other.reads, effect.writes |= other.writes;
}

bool continues(const Epoch& earlier, const Epoch& later) {
  return !earlier.writes && !later.writes && earlier.effect.layout == later.effect.layout && earlier.queue == later.queue &&
         later.queue != kSeveralQueues;
}

std::vector<Line> find_epochs(const Frame& frame, const Schedule& schedule) {
  const UsesOfCells uses(frame, schedule);
  std::vector<Line> lines;
  for (uint32_t cell = 0; cell < frame.cells.size(); ++cell) {
    if (frame.cells[cell].age != 0) continue;
    const Grid& grid = frame.grids[frame.cells[cell].resource];
    Line line{cell, {}};
    for (uint32_t age = 0; age < grid.ages; ++age) add_rows(line.epochs, age, uses.of(cell + age * grid.cells_per_age()), schedule);
    if (line.epochs.empty()) continue;
    for (Epoch& epoch : line.epochs) epoch.covered = epoch.effect;
    if (crosses_frames(frame.resource_of(cell).lifetime)) cover_continued_reads(line);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace rg::compiler
