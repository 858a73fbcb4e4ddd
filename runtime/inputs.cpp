#include "runtime/inputs.h"

#include <algorithm>
#include <cstring>

#include "runtime/barriers.h"
#include "runtime/capabilities.h"
#include "runtime/descriptors.h"
#include "runtime/errors.h"
#include "runtime/transfers.h"
#include "runtime/views.h"

namespace rg {

namespace {

Error wrong(std::string message) { return Error{ErrorCode::invalid_argument, std::move(message)}; }

Status check_imports(const GraphInstance::State& state, const FrameInputs& inputs) {
  if (inputs.imports.size() < state.imports.size())
    return wrong("too few imports: " + std::to_string(inputs.imports.size()) + " of " + std::to_string(state.imports.size()));
  for (const Index index : state.imported) {
    const Resource& resource = state.context.plan.resources[index];
    const Import& import = inputs.imports[resource.import_slot];
    const bool present = resource.kind == ResourceKind::image ? import.image.image != VK_NULL_HANDLE : import.buffer.buffer != VK_NULL_HANDLE;
    if (!present) return wrong("nothing is imported for `" + std::string(resource.name) + "`");
  }
  return Done{};
}

Status check_params(const Plan& plan, const FrameInputs& inputs) {
  if (inputs.params.size() < plan.params.size()) return wrong("too few parameter blocks");
  for (size_t i = 0; i < plan.params.size(); ++i)
    if (inputs.params[i].size() != plan.params[i].bytes)
      return wrong("parameter block `" + std::string(plan.params[i].name) + "` has " + std::to_string(inputs.params[i].size()) +
                   " bytes instead of " + std::to_string(plan.params[i].bytes));
  return Done{};
}

// The values of all features, and the conditions that follow.
void decide_features(GraphInstance::State& state, FrameInputs& inputs) {
  const Plan& plan = state.context.plan;
  if (plan.features.empty()) return;
  for (size_t i = 0; i < plan.features.size(); ++i) {
    const Feature& feature = plan.features[i];
    const bool by_device = feature.capability != Capability::none;
    if (by_device)
      state.features[i] = (state.context.device.capabilities & bit(feature.capability)) != 0;
    else
      state.features[i] = inputs.features.empty() ? feature.initial : inputs.features[i];
  }
  inputs.features = state.features;
  for (const FeatureCondition& row : plan.feature_conditions) {
    const uint64_t condition = uint64_t{1} << row.condition;
    const bool holds = (row.values >> state.features[row.feature] & 1) != 0;
    inputs.conditions = holds ? inputs.conditions | condition : inputs.conditions & ~condition;
  }
}

Status check_features(GraphInstance::State& state, FrameInputs& inputs) {
  const Plan& plan = state.context.plan;
  if (!inputs.features.empty() && inputs.features.size() < plan.features.size()) return wrong("too few feature values");
  for (size_t i = 0; i < plan.features.size() && !inputs.features.empty(); ++i)
    if (inputs.features[i] >= plan.features[i].values)
      return wrong("feature `" + std::string(plan.features[i].name) + "` has no value " + std::to_string(inputs.features[i]));
  decide_features(state, inputs);
  for (const Index index : state.choosing_passes) {
    const Pass& pass = plan.passes[index];
    if ((pass.guard & ~inputs.conditions) != 0) continue;
    if (plan.pipeline_choices[pass.first_choice + selected_choice(plan, pass, inputs)] == kNone)
      return wrong("the feature values given exclude each other in pass `" + std::string(pass.name) + "`");
  }
  return Done{};
}

Status check_semaphores(const GraphInstance::State& state, std::span<const SemaphoreUse> uses, std::string_view verb) {
  if (uses.size() > kMaxExternalSemaphores)
    return wrong("a frame " + std::string(verb) + " " + std::to_string(uses.size()) + " semaphores; at most " +
                 std::to_string(kMaxExternalSemaphores));
  for (const SemaphoreUse& use : uses) {
    if (use.semaphore == VK_NULL_HANDLE) return wrong("the frame " + std::string(verb) + " no semaphore");
    if (use.import_slot != kNone && use.import_slot >= state.imports.size())
      return wrong("a semaphore guards import slot " + std::to_string(use.import_slot) + " of " + std::to_string(state.imports.size()));
    if (use.import_slot != kNone && state.import_uses[use.import_slot].first.empty())
      return wrong("a semaphore guards an import that no pass touches: slot " + std::to_string(use.import_slot));
  }
  return Done{};
}

// No branch a pass: the one that is missing is looked for when there is one.
bool all_called(const GraphInstance::State& state, const FrameInputs& inputs) {
  bool all = true;
  for (const Index slot : state.host_slots) all &= inputs.callbacks[slot] != nullptr;
  return all;
}

}  // namespace

uint32_t selected_choice(const Plan& plan, const Pass& pass, const FrameInputs& inputs) {
  uint32_t selector = 0;
  for (const Index index : plan.pass_features.subspan(pass.first_feature, pass.feature_count)) {
    const Feature& feature = plan.features[index];
    selector = selector * feature.values + (inputs.features.empty() ? feature.initial : inputs.features[index]);
  }
  return selector;
}

Status check_inputs(GraphInstance::State& state, FrameInputs& inputs) {
  const Plan& plan = state.context.plan;
  RG_TRY(check_imports(state, inputs));
  RG_TRY(check_params(plan, inputs));
  RG_TRY(check_features(state, inputs));
  if (!state.host_passes.empty() && inputs.callbacks == nullptr) return wrong("no callbacks");
  if (!all_called(state, inputs))
    for (size_t i = 0; i < state.host_slots.size(); ++i)
      if (inputs.callbacks[state.host_slots[i]] == nullptr)
        return wrong("pass `" + std::string(plan.passes[state.host_passes[i]].name) + "` has no callback");
  if (inputs.updates.size() < state.update_slots) return wrong("too few updates");
  if (inputs.engine_sets.size() < plan.engine_sets.size()) return wrong("too few engine sets");
  RG_TRY(check_semaphores(state, inputs.waits, "waits for"));
  return check_semaphores(state, inputs.signals, "signals");
}

namespace {

bool same_imports(const std::vector<Import>& held, std::span<const Import> given) {
  for (size_t i = 0; i < held.size(); ++i) {
    const Import &a = held[i], &b = given[i];
    if (a.image.image != b.image.image || a.image.view != b.image.view || a.buffer.buffer != b.buffer.buffer || a.buffer.offset != b.buffer.offset ||
        a.buffer.size != b.buffer.size)
      return false;
  }
  return true;
}

Status take_imports(GraphInstance::State& state, const FrameInputs& inputs) {
  if (!same_imports(state.imports, inputs.imports) || !state.imports_applied) {
    std::copy_n(inputs.imports.begin(), state.imports.size(), state.imports.begin());
    update_imported_barriers(state.context, *state.sized, state.imports);
  }
  state.imports_applied = true;
  RG_TRY(update_imported_views(state.context, *state.sized, state.imports, state.frame));
  update_imported_bindings(state.context, *state.sized, state.imports, state.frame);
  return Done{};
}

void write_params(const GraphInstance::State& state, const FrameInputs& inputs) {
  const Ring& ring = state.sized->ring;
  for (size_t i = 0; i < state.context.plan.params.size(); ++i)
    if (!inputs.params[i].empty())
      std::memcpy(ring.mapped + state.frame % state.context.frames_in_flight * ring.section + ring.param_offsets[i], inputs.params[i].data(),
                  inputs.params[i].size());
}

}  // namespace

Status take_inputs(GraphInstance::State& state, const FrameInputs& inputs) {
  RG_TRY(take_imports(state, inputs));
  write_params(state, inputs);
  return write_updates(state.context, *state.sized, inputs, state.frame);
}

}  // namespace rg
