#include "runtime/slots.h"

#include <algorithm>
#include <bit>
#include <system_error>

#include "runtime/errors.h"
#include "runtime/queues.h"
#include "runtime/timelines.h"
#include "runtime/workers.h"

namespace rg {

namespace {

// ---- cutting ------------------------------------------------------------------------------------------------------

uint32_t pool_for(GraphInstance::State& state, uint32_t family, bool own) {
  const auto known = std::find(state.pool_families.begin(), state.pool_families.end(), family);
  if (!own && known != state.pool_families.end()) return static_cast<uint32_t>(known - state.pool_families.begin());
  state.pool_families.push_back(family);
  return static_cast<uint32_t>(state.pool_families.size() - 1);
}

// How many command buffers a batch becomes: its share of twice as many as there are threads, so that none waits long for the last one.
uint32_t pieces_of(const Context& context, const Batch& batch) {
  if (context.submit_per_pass) return std::max(batch.step_count, 1u);
  if (context.threads <= 1) return 1;
  const uint64_t share = uint64_t{2} * context.threads * batch.step_count / std::max<size_t>(context.plan.steps.size(), 1);
  return std::clamp<uint32_t>(static_cast<uint32_t>(share), 1, std::max(batch.step_count, 1u));
}

// A command buffer holds whole renderings, unless every pass stands alone.
bool is_within_rendering(const GraphInstance::State& state, Index step) {
  const Step& row = state.context.plan.steps[step];
  return !state.context.submit_per_pass && row.kind == StepKind::pass && !state.objects.passes[row.index].part.first;
}

void cut_batch(GraphInstance::State& state, Index b) {
  const Batch& batch = state.context.plan.batches[b];
  const uint32_t pieces = pieces_of(state.context, batch);
  const uint32_t family = family_of(state.context, batch.queue);
  uint32_t begin = 0;
  for (uint32_t i = 0; i < pieces; ++i) {
    uint32_t end = static_cast<uint32_t>(uint64_t{batch.step_count} * (i + 1) / pieces);
    while (end < batch.step_count && is_within_rendering(state, batch.first_step + end)) ++end;
    if (end <= begin && i > 0) continue;
    state.chunks.push_back({b, batch.first_step + begin, end - begin, pool_for(state, family, state.context.threads > 1)});
    begin = end;
  }
}

void cut_frame(GraphInstance::State& state) {
  const Plan& plan = state.context.plan;
  state.first_batch_of_queue.assign(plan.queues.size(), kNone);
  for (Index b = 0; b < plan.batches.size(); ++b) {
    const uint32_t queue = state.context.queues.device_queue[plan.batches[b].queue];
    state.first_chunk.push_back(static_cast<uint32_t>(state.chunks.size()));
    cut_batch(state, b);
    if (state.calls.empty() || state.calls.back().queue != queue) state.calls.push_back({queue, b, 0});
    ++state.calls.back().batch_count;
    Index& first = state.first_batch_of_queue[plan.batches[b].queue];
    first = std::min(first, b);
  }
  state.first_chunk.push_back(static_cast<uint32_t>(state.chunks.size()));
}

// ---- imports ------------------------------------------------------------------------------------------------------

bool touches(const Plan& plan, const Batch& batch, Index slot) {
  for (const Step& step : plan.steps.subspan(batch.first_step, batch.step_count)) {
    if (step.kind != StepKind::pass) continue;
    const Pass& pass = plan.passes[step.index];
    for (const Access& access : plan.accesses.subspan(pass.first_access, pass.access_count))
      if (plan.resources[access.ref.resource].import_slot == slot && plan.resources[access.ref.resource].lifetime == Lifetime::imported) return true;
  }
  return false;
}

ImportUse find_uses(const Plan& plan, Index slot) {
  ImportUse use;
  std::vector<Index> last(plan.queues.size(), kNone);
  for (Index b = 0; b < plan.batches.size(); ++b) {
    if (!touches(plan, plan.batches[b], slot)) continue;
    Index& of_queue = last[plan.batches[b].queue];
    if (of_queue == kNone) use.first.push_back(b);
    of_queue = b;
  }
  for (const Index b : last)
    if (b != kNone) use.last.push_back(b);
  return use;
}

// ---- objects ------------------------------------------------------------------------------------------------------

Result<CommandPool> create_pool(const Context& context, uint32_t family) {
  if (CommandPool spare = context.device.take_pool(family); spare.pool) return spare;
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = family;
  VkCommandPool pool = VK_NULL_HANDLE;
  RG_TRY(
      check(context.vk().CreateCommandPool(context.device.device, &info, context.vk().allocator, &pool), "vkCreateCommandPool", context.plan.name));
  return CommandPool{family, UniqueCommandPool(context.vk(), context.device.device, pool), {}, 0};
}

Status allocate(const Context& context, CommandPool& pool, VkCommandBuffer& commands) {
  if (pool.used < pool.commands.size()) {
    commands = pool.commands[pool.used++];
    return Done{};
  }
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool.pool.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  RG_TRY(check(context.vk().AllocateCommandBuffers(context.device.device, &info, &commands), "vkAllocateCommandBuffers", context.plan.name));
  pool.commands.push_back(commands);
  ++pool.used;
  return Done{};
}

Status create_fences(const Context& context, std::vector<UniqueFence>& fences, std::vector<bool>& fenced) {
  if (!context.device.validating) return Done{};
  fenced.resize(context.device.queues.size());
  for (size_t i = 0; i < context.device.queues.size(); ++i) {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateFence(context.device.device, &info, context.vk().allocator, &fence), "vkCreateFence", context.plan.name));
    fences.emplace_back(context.vk(), context.device.device, fence);
  }
  return Done{};
}

Result<UniqueQueryPool> create_queries(const Context& context, VkQueryType type, uint32_t count) {
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = type;
  info.queryCount = count;
  if (type == VK_QUERY_TYPE_PIPELINE_STATISTICS) info.pipelineStatistics = kPipelineStatistics;
  VkQueryPool pool = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateQueryPool(context.device.device, &info, context.vk().allocator, &pool), "vkCreateQueryPool", context.plan.name));
  return UniqueQueryPool(context.vk(), context.device.device, pool);
}

// Queries behind the last: lavapipe of Mesa 25 writes as many timestamps as the rendering before had views, whether they exist or not.
uint32_t spare_queries(const Plan& plan) {
  int views = 0;
  for (const Rendering& rendering : plan.renderings) views = std::max(views, std::popcount(rendering.view_mask));
  return static_cast<uint32_t>(views);
}

Status create_slot_queries(const Context& context, FrameSlot& slot) {
  const auto passes = static_cast<uint32_t>(context.plan.passes.size());
  if (passes == 0 || context.submit_per_pass) return Done{};
  if (context.timestamps && context.device.queues[0].timestamp_bits != 0) {
    Result<UniqueQueryPool> pool = create_queries(context, VK_QUERY_TYPE_TIMESTAMP, 2 * passes + spare_queries(context.plan));
    if (!pool) return pool.error();
    slot.queries = std::move(*pool);
  }
  if (context.statistics && context.device.pipeline_statistics) {
    Result<UniqueQueryPool> pool = create_queries(context, VK_QUERY_TYPE_PIPELINE_STATISTICS, passes);
    if (!pool) return pool.error();
    slot.statistics = std::move(*pool);
  }
  return Done{};
}

// Where every step waits for the one before there is nothing that an event could save.
Status create_events(const Context& context, std::vector<UniqueEvent>& events) {
  if (context.submit_per_pass || context.serial) return Done{};
  const auto& groups = context.plan.groups;
  const auto count = std::count_if(groups.begin(), groups.end(), [](const BarrierGroup& group) { return group.event != kNone; });
  for (ptrdiff_t i = 0; i < count; ++i) {
    VkEventCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_EVENT_CREATE_INFO;
    VkEvent event = VK_NULL_HANDLE;
    RG_TRY(check(context.vk().CreateEvent(context.device.device, &info, context.vk().allocator, &event), "vkCreateEvent", context.plan.name));
    events.emplace_back(context.vk(), context.device.device, event);
  }
  return Done{};
}

Status create_slot(const GraphInstance::State& state, FrameSlot& slot) {
  for (const uint32_t family : state.pool_families) {
    Result<CommandPool> pool = create_pool(state.context, family);
    if (!pool) return pool.error();
    slot.pools.push_back(std::move(*pool));
  }
  slot.commands.resize(state.chunks.size());
  for (size_t i = 0; i < state.chunks.size(); ++i) RG_TRY(allocate(state.context, slot.pools[state.chunks[i].pool], slot.commands[i]));
  RG_TRY(create_slot_queries(state.context, slot));
  RG_TRY(create_events(state.context, slot.events));
  return create_fences(state.context, slot.fences, slot.fenced);
}

Status create_prologue(const Context& context, Prologue& prologue) {
  prologue.commands.resize(context.queues.families.size());
  for (size_t i = 0; i < context.queues.families.size(); ++i) {
    Result<CommandPool> pool = create_pool(context, context.queues.families[i]);
    if (!pool) return pool.error();
    prologue.pools.push_back(std::move(*pool));
    RG_TRY(allocate(context, prologue.pools.back(), prologue.commands[i]));
  }
  return create_fences(context, prologue.fences, prologue.fenced);
}

void reserve_submits(GraphInstance::State& state) {
  const Plan& plan = state.context.plan;
  const size_t entries = 3 * (1 + kMaxPlanQueues);  // of the prologue, of the instance before, of the heap's last user
  state.submits.reserve(plan.batches.size() + 2);
  state.submit_commands.resize(state.chunks.size());
  state.entry_waits.reserve(entries);
  state.submit_waits.reserve(plan.waits.size() + plan.queues.size() * entries + kMaxExternalSemaphores * plan.queues.size() + kMaxPlanQueues);
  state.submit_signals.reserve(plan.signals.size() + 2 + kMaxExternalSemaphores);
  state.waits.reserve(kMaxExternalSemaphores);
  state.signals.reserve(kMaxExternalSemaphores);
  state.entry_sources.reserve(2);
  for (FrameSlot& slot : state.slots) slot.sources.reserve(2);
  state.own_commands.reserve(kMaxOwnCommands);
  state.chunk_results.resize(state.chunks.size());
  state.wall_ms.resize(plan.passes.size());
}

}  // namespace

Status create_workers(GraphInstance::State& state) {
  if (state.context.threads <= 1 || state.context.parallel.run != nullptr) return Done{};
  try {
    state.workers.reset(new Workers(state.context.threads - 1));
  } catch (const std::system_error& error) {
    return Error{ErrorCode::unsupported, "no more threads: " + std::string(error.what())};
  }
  return Done{};
}

Status create_frames(GraphInstance::State& state) {
  RG_TRY(create_timelines(state));
  cut_frame(state);
  for (Index slot = 0; slot < state.imports.size(); ++slot) state.import_uses.push_back(find_uses(state.context.plan, slot));
  RG_TRY(create_prologue(state.context, state.prologue));
  state.slots.resize(state.context.frames_in_flight);
  for (FrameSlot& slot : state.slots) RG_TRY(create_slot(state, slot));
  reserve_submits(state);
  return Done{};
}

Status reset_commands(const Context& context, const FrameSlot& slot) {
  for (const CommandPool& pool : slot.pools)
    RG_TRY(check(context.vk().ResetCommandPool(context.device.device, pool.pool.get(), 0), "vkResetCommandPool", context.plan.name));
  return Done{};
}

Status reset_events(const Context& context, const FrameSlot& slot) {
  for (const UniqueEvent& event : slot.events)
    RG_TRY(check(context.vk().ResetEvent(context.device.device, event.get()), "vkResetEvent", context.plan.name));
  return Done{};
}

void reset_slot_queries(const Context& context, const FrameSlot& slot) {
  if (!context.device.host_query_reset) return;
  const auto passes = static_cast<uint32_t>(context.plan.passes.size());
  if (slot.queries) context.vk().ResetQueryPool(context.device.device, slot.queries.get(), 0, 2 * passes);
  if (slot.statistics) context.vk().ResetQueryPool(context.device.device, slot.statistics.get(), 0, passes);
}

}  // namespace rg
