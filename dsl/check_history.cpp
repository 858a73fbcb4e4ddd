// Frames that do not write a history carry it forward: where no write reaches the end of the frame for certain, the frame begins with a copy of the
// previous version. Where a feature or a later write makes the copy needless, nothing reads it and it is culled like any other pass.
#include <algorithm>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

Access side(const Resource& resource, ResourceId id, uint32_t age, Mode mode, Role role) {
  Access access;
  access.resource = id;
  access.age = age;
  access.mode = mode;
  access.role = role;
  access.name = age > 0 ? "previous" : "current";
  access.span = resource.span;
  if (resource.kind == ResourceKind::image) access.range.aspects = info(resource.format).aspects;
  return access;
}

Pass carry_pass(const Resource& resource, ResourceId id) {
  Pass pass;
  pass.name = resource.name + ".carry";
  pass.module = resource.module;
  pass.kind = PassKind::transfer;
  pass.guard = resource.guard;
  pass.span = resource.span;
  pass.accesses = {side(resource, id, 1, Mode::read, Role::copy_src), side(resource, id, 0, Mode::write, Role::copy_dst)};
  Transfer transfer;
  transfer.kind = TransferKind::copy;
  transfer.src = 0;
  transfer.dst = 1;
  pass.transfers.push_back(transfer);
  return pass;
}

void shift(PassId& id, uint32_t by) {
  if (id.valid()) id.value += by;
}

}  // namespace

void carry_forward(Graph& graph, const std::vector<ResourceId>& histories) {
  if (histories.empty()) return;
  const auto by = static_cast<uint32_t>(histories.size());
  for (Params& params : graph.params) shift(params.pass, by);
  std::vector<Pass> passes;
  for (const ResourceId id : histories) passes.push_back(carry_pass(graph.resources[id], id));
  for (Pass& pass : graph.passes) {
    for (PassId& other : pass.after) shift(other, by);
    passes.push_back(std::move(pass));
  }
  graph.passes.rows = std::move(passes);
}

}  // namespace rg::dsl
