#include "runtime/errors.h"
#include "runtime/resolve.h"
#include "runtime/timelines.h"

namespace rg {

namespace {

Status check_readback(const Plan& plan, Index resource, uint64_t frames) {
  if (resource >= plan.resources.size() || plan.resources[resource].lifetime != Lifetime::readback ||
      plan.resources[resource].kind != ResourceKind::buffer)
    return Error{ErrorCode::invalid_argument, "resource " + std::to_string(resource) + " is no readback buffer"};
  if (frames == 0)
    return Error{ErrorCode::invalid_argument, "`" + std::string(plan.resources[resource].name) + "`: no frame was executed since creation or resize"};
  return Done{};
}

}  // namespace

Result<std::span<const std::byte>> GraphInstance::readback(Index resource) {
  RG_TRY(check_readback(state_->context.plan, resource, state_->frame - state_->sized_at));
  RG_TRY(wait_for(*state_, state_->submitted));
  const SizedResource& row = state_->sized->resources[resource];
  // The memory is coherent: the frame's barrier to the host and the wait make it visible.
  const HostCopy& copy = state_->sized->host_copies[copy_index(row, 0, state_->frame - 1)];
  return std::span<const std::byte>(copy.mapped, row.bytes);
}

}  // namespace rg
