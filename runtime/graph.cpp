#include "runtime/graph.h"

#include <algorithm>
#include <thread>

#include "runtime/barriers.h"
#include "runtime/capabilities.h"
#include "runtime/descriptors.h"
#include "runtime/errors.h"
#include "runtime/executor.h"
#include "runtime/pass_tables.h"
#include "runtime/pipelines.h"
#include "runtime/plan_check.h"
#include "runtime/queues.h"
#include "runtime/record_rows.h"
#include "runtime/resources.h"
#include "runtime/samplers.h"
#include "runtime/slots.h"
#include "runtime/submit.h"
#include "runtime/timelines.h"
#include "runtime/turns.h"

namespace rg {

GraphInstance::GraphInstance(std::unique_ptr<State> state) : state_(std::move(state)) {}
GraphInstance::GraphInstance(GraphInstance&&) noexcept = default;
GraphInstance& GraphInstance::operator=(GraphInstance&&) noexcept = default;
GraphInstance::~GraphInstance() = default;

GraphInstance::State::~State() {
  if (!context.device.lost) static_cast<void>(wait_for(*this, submitted));  // with a lost device nothing is in flight
  for (FrameSlot& slot : slots)
    for (CommandPool& pool : slot.pools) context.device.give_pool(std::move(pool));
  for (CommandPool& pool : prologue.pools) context.device.give_pool(std::move(pool));
  for (FrameSlot& slot : slots)
    for (std::shared_ptr<Timelines>& source : slot.sources) context.device.rest(std::move(source));
  for (std::shared_ptr<Timelines>& source : entry_sources) context.device.rest(std::move(source));
  if (!context.plan.waits.empty() || context.heap || timelines.use_count() > 1) context.device.rest(timelines);
  if (context.heap && context.heap->last_user == this) context.heap->last_user = nullptr, context.heap->timelines = nullptr;
}

namespace {

Status check_options(const Plan& plan, const GraphOptions& options) {
  if (options.frames_in_flight < 1 || options.frames_in_flight > 4)
    return Error{ErrorCode::invalid_argument, "frames in flight: " + std::to_string(options.frames_in_flight) + " is not in 1 to 4"};
  if (options.threads < 1 || options.threads > 64)
    return Error{ErrorCode::invalid_argument, "threads: " + std::to_string(options.threads) + " is not in 1 to 64"};
  if (options.pipeline_threads > 64)
    return Error{ErrorCode::invalid_argument, "threads that make pipelines: " + std::to_string(options.pipeline_threads) + " is not in 0 to 64"};
  if (options.engine_set_layouts.size() < plan.engine_sets.size())
    return Error{ErrorCode::invalid_argument, "graph `" + std::string(plan.name) + "` uses " + std::to_string(plan.engine_sets.size()) +
                                                  " engine sets; layouts given: " + std::to_string(options.engine_set_layouts.size())};
  return Done{};
}

uint32_t pipeline_threads(const Device::State& device, const GraphOptions& options) {
  if (options.pipeline_threads != 0) return options.pipeline_threads;
  if (device.null) return 1;
  return options.threads > 1 ? options.threads : std::clamp(std::thread::hardware_concurrency(), 1u, 64u);
}

Context make_context(Device::State& device, const Plan& plan, const GraphOptions& options) {
  Context context{device, plan};
  context.frames_in_flight = options.frames_in_flight;
  context.threads = options.submit_per_pass ? 1 : options.threads;
  context.pipeline_threads = pipeline_threads(device, options);
  context.aliasing = options.aliasing;
  context.poison = options.poison;
  context.debug_readback = options.debug_readback;
  context.submit_per_pass = options.submit_per_pass;
  context.serial = options.serial;
  context.timestamps = options.timestamps;
  context.statistics = options.statistics;
  context.engine_set_layouts.assign(options.engine_set_layouts.begin(), options.engine_set_layouts.end());
  context.parallel = options.parallel;
  context.heap = options.heap;
  context.queues = map_queues(device, plan, options.single_queue || options.serial);
  return context;
}

std::vector<int64_t> initial_extents(const Plan& plan) {
  std::vector<int64_t> values;
  for (const Extent& extent : plan.extents) values.insert(values.end(), std::begin(extent.initial), std::end(extent.initial));
  return values;
}

Status check_extents(const Plan& plan, std::span<const int64_t> values) {
  if (values.size() != plan.extents.size() * 3)
    return Error{ErrorCode::invalid_argument,
                 "extents: " + std::to_string(values.size()) + " values instead of " + std::to_string(plan.extents.size() * 3)};
  for (size_t i = 0; i < values.size(); ++i) {
    const Extent& extent = plan.extents[i / 3];
    if (i % 3 >= extent.axes) continue;
    if (values[i] < extent.minimum[i % 3] || values[i] > extent.maximum[i % 3])
      return Error{ErrorCode::invalid_argument, "extent `" + std::string(extent.name) + "`: " + std::to_string(values[i]) + " is not in " +
                                                    std::to_string(extent.minimum[i % 3]) + " to " + std::to_string(extent.maximum[i % 3])};
  }
  return Done{};
}

// Everything that depends on extents, or an error and nothing.
Result<std::unique_ptr<Sized>> create_sized(const Context& context, const Objects& objects, std::span<const int64_t> extents, const Carried* from) {
  auto sized = std::make_unique<Sized>();
  sized->extents.assign(extents.begin(), extents.end());
  RG_TRY(size_resources(context, *sized));
  RG_TRY(create_resources(context, from, *sized));
  RG_TRY(create_pass_tables(context, objects, *sized));
  RG_TRY(create_ring(context, *sized));
  RG_TRY(create_sets(context, objects, *sized));
  // Beyond this point offsets are fixed: hand-offs of shared memory follow from them.
  create_barriers(context, *sized);
  fill_rows(context, objects, *sized);
  fill_step_rows(context, objects, *sized);
  return sized;
}

void count_slots(GraphInstance::State& state) {
  const Plan& plan = state.context.plan;
  uint32_t imports = 0;
  for (Index r = 0; r < plan.resources.size(); ++r) {
    if (plan.resources[r].lifetime != Lifetime::imported) continue;
    state.imported.push_back(r);
    imports = std::max(imports, plan.resources[r].import_slot + 1);
  }
  state.imports.resize(imports);
  for (Index p = 0; p < plan.passes.size(); ++p)
    if (plan.passes[p].work.kind == WorkKind::host) state.host_passes.push_back(p), state.host_slots.push_back(plan.passes[p].host_slot);
  for (Index p = 0; p < plan.passes.size(); ++p)
    if (plan.passes[p].choice_count != 0) state.choosing_passes.push_back(p);
  for (const Transfer& transfer : plan.transfers)
    if (transfer.kind == TransferKind::update) state.update_slots = std::max(state.update_slots, transfer.update_slot + 1);
}

// What was found in its initial state by the next frame.
void date_contents(const GraphInstance::State& state, Sized& sized) {
  for (size_t r = 0; r < sized.kept.size(); ++r)
    if (sized.kept[r] && !sized.carried[r]) sized.kept[r]->valid_since = state.frame;
}

Status rebuild(GraphInstance::State& state, std::span<const int64_t> extents, const Carried* from = nullptr) {
  RG_TRY(check_extents(state.context.plan, extents));
  Result<std::unique_ptr<Sized>> sized = create_sized(state.context, state.objects, extents, from);
  if (!sized) return sized.error();
  state.retired.reserve(state.retired.size() + 1);
  (*sized)->carried_from = from != nullptr ? &from->plan : nullptr;
  const Status submitted = submit_prologue(state, **sized);
  if (!submitted) return submitted.error();
  (*sized)->carried_from = nullptr;
  date_contents(state, **sized);
  // In a shared heap the new transients may lie where the old ones are still in use.
  if (state.sized && state.context.heap) wait_at_entry(state, state.timelines, state.submitted);
  if (state.sized) state.retired.push_back({state.submitted, std::move(state.sized)});
  state.sized = std::move(*sized);
  state.imports_applied = false;
  state.invalidated.clear();  // all of it is as declared, or another instance's
  state.sized_at = state.frame;
  std::erase_if(state.dumps, [](const DumpRequest& dump) { return !dump.recorded; });  // asked for at other extents
  return Done{};
}

}  // namespace

namespace {

// How many draws there are is known to the GPU alone: nothing else does the same.
Status check_draws(const Device::State& device, const Plan& plan) {
  for (const Pass& pass : plan.passes) {
    const bool counted = pass.work.kind == WorkKind::draw_indirect_count || pass.work.kind == WorkKind::draw_indexed_indirect_count;
    if (counted && !device.draw_indirect_count)
      return Error{ErrorCode::unsupported, "pass `" + std::string(pass.name) + "` takes the number of its draws from a buffer, which `" +
                                               device.name + "` cannot (drawIndirectCount)"};
  }
  return Done{};
}

Result<std::unique_ptr<GraphInstance::State>> create_state(Device::State& device, const Plan& plan, const GraphOptions& options,
                                                           const Predecessor* before) {
  RG_TRY(check_plan(plan));
  RG_TRY(check_options(plan, options));
  auto state = std::make_unique<GraphInstance::State>(make_context(device, plan, options));
  for (const Capability capability : plan.needs)
    if ((device.capabilities & bit(capability)) == 0)
      return Error{ErrorCode::unsupported, "plan `" + std::string(plan.name) + "` is for devices with " + std::string(name(capability)) +
                                               ", which `" + device.name + "` lacks; take another variant of it"};
  RG_TRY(check_draws(device, plan));
  state->features.resize(plan.features.size());
  count_slots(*state);
  RG_TRY(create_samplers(state->context, state->objects));
  RG_TRY(create_workers(*state));
  RG_TRY(create_pass_objects(*state, before));
  RG_TRY(create_frames(*state));
  return state;
}

}  // namespace

namespace {

Result<std::unique_ptr<GraphInstance::State>> begin(Device::State& device, const Plan& plan, const GraphOptions& options) {
  Result<std::unique_ptr<GraphInstance::State>> state = create_state(device, plan, options, nullptr);
  if (!state) return state;
  const std::vector<int64_t> initial = initial_extents(plan);
  RG_TRY(rebuild(**state, options.extents.empty() ? std::span<const int64_t>(initial) : options.extents));
  return state;
}

Result<std::unique_ptr<GraphInstance::State>> succeed(GraphInstance::State& before, const Plan& plan, const GraphOptions& options) {
  const Predecessor predecessor{before.context, before.objects};
  Result<std::unique_ptr<GraphInstance::State>> state = create_state(before.context.device, plan, options, &predecessor);
  if (!state) return state;
  GraphInstance::State& after = **state;
  after.frame = before.frame;
  wait_at_entry(after, before.timelines, before.submitted);
  const Carried from{before.context.plan, *before.sized, before.context};
  const std::vector<int64_t> initial = initial_extents(plan);
  const bool same_extents = before.sized->extents.size() == initial.size();
  const std::span<const int64_t> otherwise = same_extents ? std::span<const int64_t>(before.sized->extents) : std::span<const int64_t>(initial);
  RG_TRY(rebuild(after, options.extents.empty() ? otherwise : options.extents, &from));
  return state;
}

}  // namespace

Result<GraphInstance> GraphInstance::create(Device& device, const Plan& plan, const GraphOptions& options) {
  if (device.state().lost) return lost_device();
  Result<std::unique_ptr<State>> state = guarded(device.state(), begin(device.state(), plan, options));
  if (!state) return state.error();
  return GraphInstance(std::move(*state));
}

Result<GraphInstance> GraphInstance::create_successor(GraphInstance& current, const Plan& plan, const GraphOptions& options) {
  State& before = *current.state_;
  if (before.context.device.lost) return lost_device();
  Result<std::unique_ptr<State>> state = guarded(before.context.device, succeed(before, plan, options));
  if (!state) return state.error();
  return GraphInstance(std::move(*state));
}

Status GraphInstance::continue_from(GraphInstance& other) {
  if (&other == this) return Done{};
  return follow(*state_, *other.state_);
}

namespace {

// What a frame submitted in part leaves behind is thrown away.
Status mend(GraphInstance::State& state) {
  if (!state.broken) return Done{};
  RG_TRY(mend_timelines(state));
  const std::vector<int64_t> extents = state.sized->extents;
  RG_TRY(rebuild(state, extents));
  state.broken = false;
  return Done{};
}

// A prologue for the resources that were invalidated and no other. It follows the frames before; the next frame follows it.
Status run_invalidations(GraphInstance::State& state) {
  if (state.invalidated.empty()) return Done{};
  Sized& sized = *state.sized;
  std::vector<bool> others(sized.carried.size(), true);
  for (const Index resource : state.invalidated) others[resource] = false;
  wait_at_entry(state, state.timelines, state.submitted);
  sized.carried.swap(others);
  sized.resets = true;
  const Status submitted = submit_prologue(state, sized);
  sized.resets = false;
  sized.carried.swap(others);
  RG_TRY(submitted);
  for (const Index resource : state.invalidated) sized.kept[resource]->valid_since = state.frame;
  state.invalidated.clear();
  return Done{};
}

Status mend_and_execute(GraphInstance::State& state, const FrameInputs& inputs) {
  RG_TRY(mend(state));
  RG_TRY(run_invalidations(state));
  if (state.own_commands.empty()) return execute_frame(state, inputs);
  if (!inputs.waits.empty() || !inputs.signals.empty())
    return Error{ErrorCode::invalid_argument, "who submits a frame's commands waits for semaphores and signals them there"};
  const Status recorded = record_own_frame(state, inputs, state.own_commands, state.own_done);
  state.own_commands.clear();
  return recorded;
}

Status mend_and_resize(GraphInstance::State& state, std::span<const int64_t> extents) {
  if (state.broken) RG_TRY(mend_timelines(state));
  RG_TRY(rebuild(state, extents));
  state.broken = false;
  return Done{};
}

}  // namespace

Status GraphInstance::resize(std::span<const int64_t> extents) {
  Device::State& device = state_->context.device;
  return device.lost ? Status(lost_device()) : guarded(device, mend_and_resize(*state_, extents));
}

namespace {

// A mended instance or a failed frame may be tried again with the same semaphores.
Status execute_with_semaphores(GraphInstance::State& state, const FrameInputs& inputs) {
  if (state.waits.empty() && state.signals.empty()) return mend_and_execute(state, inputs);
  std::array<SemaphoreUse, 2 * kMaxExternalSemaphores> waits, signals;
  auto join = [](const std::vector<SemaphoreUse>& ours, std::span<const SemaphoreUse> given, auto& out) {
    const size_t count = std::min(out.size(), ours.size() + given.size());
    std::copy(ours.begin(), ours.end(), out.begin());
    std::copy_n(given.begin(), count - ours.size(), out.begin() + static_cast<ptrdiff_t>(ours.size()));
    return std::span<const SemaphoreUse>(out.data(), count);
  };
  FrameInputs joined = inputs;
  joined.waits = join(state.waits, inputs.waits, waits);
  joined.signals = join(state.signals, inputs.signals, signals);
  RG_TRY(mend_and_execute(state, joined));
  state.waits.clear(), state.signals.clear();
  return Done{};
}

}  // namespace

Status GraphInstance::execute(const FrameInputs& inputs) {
  Device::State& device = state_->context.device;
  return device.lost ? Status(lost_device()) : guarded(device, execute_with_semaphores(*state_, inputs));
}

namespace {

// What cannot be recorded into an engine's command buffers.
Status check_own_commands(const GraphInstance::State& state, std::span<const OwnCommands> parts, const FrameDone& done) {
  auto wrong = [&](std::string text) { return Error{ErrorCode::invalid_argument, "graph `" + std::string(state.context.plan.name) + "`: " + text}; };
  if (state.context.queues.several) return wrong("plans of several queues are recorded into own commands with GraphOptions::single_queue");
  if (state.context.submit_per_pass) return wrong("submit_per_pass submits; own commands do not");
  if (parts.empty() || parts.size() > kMaxOwnCommands || done.timeline == VK_NULL_HANDLE)
    return wrong("own commands need 1 to " + std::to_string(kMaxOwnCommands) + " command buffers and a timeline semaphore");
  for (const OwnCommands& part : parts) {
    const bool up_to_pass = part.last_pass != kNone;
    if (part.commands == VK_NULL_HANDLE || (up_to_pass && part.last_pass >= state.context.plan.passes.size()))
      return wrong("own commands without a command buffer, or up to a pass that does not exist");
    if (up_to_pass && &part != &parts.back() && !state.objects.passes[part.last_pass].part.last)
      return wrong("own commands up to `" + std::string(state.context.plan.passes[part.last_pass].name) +
                   "`, whose rendering the next pass continues; end the part after the last of them, or compile with `--no-merge=" +
                   std::string(state.context.plan.passes[part.last_pass].name) + "`");
  }
  return Done{};
}

}  // namespace

Status GraphInstance::use_commands(std::span<const OwnCommands> parts, const FrameDone& done) {
  RG_TRY(check_own_commands(*state_, parts, done));
  state_->own_commands.assign(parts.begin(), parts.end());
  state_->own_done = done;
  return Done{};
}

Status GraphInstance::use_semaphores(std::span<const SemaphoreUse> waits, std::span<const SemaphoreUse> signals) {
  if (state_->waits.size() + waits.size() > kMaxExternalSemaphores || state_->signals.size() + signals.size() > kMaxExternalSemaphores)
    return Error{ErrorCode::invalid_argument, "a frame waits for and signals at most " + std::to_string(kMaxExternalSemaphores) + " semaphores each"};
  state_->waits.insert(state_->waits.end(), waits.begin(), waits.end());
  state_->signals.insert(state_->signals.end(), signals.begin(), signals.end());
  return Done{};
}

Status GraphInstance::wait_idle() {
  Device::State& device = state_->context.device;
  if (device.lost) return lost_device();
  RG_TRY(guarded(device, wait_for(*state_, state_->submitted)));
  release_retired(*state_);
  return Done{};
}

const PassInfo& GraphInstance::pass_info(Index pass) const { return state_->sized->passes[pass].info; }
MemoryReport GraphInstance::memory() const { return state_->sized->report; }
std::vector<PlacedResource> GraphInstance::placements() const { return state_->sized->placements; }
uint64_t GraphInstance::frame() const { return state_->frame; }
const Plan& GraphInstance::plan() const { return state_->context.plan; }
bool GraphInstance::history_valid(Index resource) const {
  const std::vector<std::shared_ptr<Kept>>& kept = state_->sized->kept;
  return resource < kept.size() && kept[resource] != nullptr && state_->frame > kept[resource]->valid_since;
}

Status GraphInstance::invalidate(Index resource) {
  const Plan& plan = state_->context.plan;
  if (resource >= plan.resources.size() || state_->sized->kept[resource] == nullptr)
    return Error{ErrorCode::invalid_argument,
                 "graph `" + std::string(plan.name) + "`: only history and persistent resources are invalidated" +
                     (resource < plan.resources.size() ? "; `" + std::string(plan.resources[resource].name) + "` is neither" : "")};
  if (plan.resources[resource].init != InitKind::clear)
    return Error{ErrorCode::invalid_argument, "`" + std::string(plan.resources[resource].name) + "` declares no initial value to go back to"};
  std::vector<Index>& list = state_->invalidated;
  if (std::find(list.begin(), list.end(), resource) == list.end()) list.push_back(resource);
  return Done{};
}

std::shared_ptr<TransientHeap> make_transient_heap() { return std::make_shared<TransientHeap>(); }

Status GraphInstance::set_active(std::span<const int64_t> extents) {
  RG_TRY(check_extents(state_->context.plan, extents));
  for (size_t i = 0; i < extents.size(); ++i)
    if (extents[i] > state_->sized->extents[i])
      return Error{ErrorCode::invalid_argument,
                   "active extent " + std::to_string(extents[i]) +
                       " is larger than the one that memory was placed for: " + std::to_string(state_->sized->extents[i]) + "; resize first"};
  activate(state_->context, state_->objects, *state_->sized, extents);
  return Done{};
}

}  // namespace rg
