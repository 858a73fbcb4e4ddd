#include <algorithm>
#include <array>

#include "runtime/timelines.h"

namespace rg {

namespace {

// The slot of the newest frame that the device has finished; null: none.
const FrameSlot* last_finished(const GraphInstance::State& state) {
  const FrameSlot* last = nullptr;
  for (const FrameSlot& slot : state.slots)
    if (slot.frame != UINT64_MAX && (last == nullptr || slot.frame > last->frame) && reached(state, slot.done)) last = &slot;
  return last;
}

std::vector<PassTime> wall_times(const GraphInstance::State& state) {
  std::vector<PassTime> times;
  double begin = 0;
  for (size_t i = 0; i < state.wall_ms.size(); ++i) {
    times.push_back({state.objects.passes[i].name, state.wall_ms[i], begin});
    begin += state.wall_ms[i];
  }
  return times;
}

// Of timestamps that may wrap.
double elapsed_ms(const Context& context, uint64_t begin, uint64_t end) {
  const uint32_t bits = context.device.queues[0].timestamp_bits;
  const uint64_t mask = bits >= 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  return static_cast<double>((end - begin) & mask) * static_cast<double>(context.device.limits.timestampPeriod) * 1e-6;
}

struct Stamp {
  uint64_t value = 0, available = 0;
};

// Rows of queries whose results exist; the rest stays unavailable.
template <class Row>
bool read_queries(const Context& context, VkQueryPool pool, VkQueryResultFlags flags, std::vector<Row>& rows) {
  const VkResult result = context.vk().GetQueryPoolResults(context.device.device, pool, 0, static_cast<uint32_t>(rows.size()),
                                                           rows.size() * sizeof(Row), rows.data(), sizeof(Row), VK_QUERY_RESULT_64_BIT | flags);
  return result == VK_SUCCESS || result == VK_NOT_READY;
}

}  // namespace

std::vector<PassTime> GraphInstance::pass_times() {
  if (state_->frame == 0) return {};
  if (state_->context.submit_per_pass) return wall_times(*state_);
  const FrameSlot* slot = last_finished(*state_);
  const size_t passes = state_->objects.passes.size();
  if (slot == nullptr || !slot->queries || passes == 0) return {};
  std::vector<Stamp> stamps(2 * passes);
  if (!read_queries(state_->context, slot->queries.get(), VK_QUERY_RESULT_WITH_AVAILABILITY_BIT, stamps)) return {};
  uint64_t first = UINT64_MAX;
  for (const Stamp& stamp : stamps)
    if (stamp.available != 0) first = std::min(first, stamp.value);
  std::vector<PassTime> times;
  for (size_t i = 0; i < passes; ++i) {
    const Stamp &begin = stamps[2 * i], &end = stamps[2 * i + 1];
    PassTime& time = times.emplace_back(PassTime{state_->objects.passes[i].name});
    if (begin.available == 0 || end.available == 0) continue;
    time.ms = elapsed_ms(state_->context, begin.value, end.value);
    time.begin_ms = elapsed_ms(state_->context, first, begin.value);
  }
  return times;
}

std::vector<PassStatistics> GraphInstance::pass_statistics() {
  const FrameSlot* slot = last_finished(*state_);
  const size_t passes = state_->objects.passes.size();
  if (slot == nullptr || !slot->statistics || passes == 0) return {};
  std::vector<std::array<uint64_t, 6>> rows(passes);
  if (!read_queries(state_->context, slot->statistics.get(), VK_QUERY_RESULT_WITH_AVAILABILITY_BIT, rows)) return {};
  std::vector<PassStatistics> out;
  for (size_t i = 0; i < passes; ++i) {
    const std::array<uint64_t, 6>& row = rows[i];
    PassStatistics& pass = out.emplace_back(PassStatistics{state_->objects.passes[i].name});
    if (row[5] != 0) pass = {pass.pass, row[0], row[1], row[2], row[3], row[4]};
  }
  return out;
}

}  // namespace rg
