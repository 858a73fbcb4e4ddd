#include "compiler/slots.h"

#include <algorithm>

namespace rg::compiler {

bool is_host_recorded(const dsl::Pass& pass) {
  if (pass.kind == dsl::PassKind::host || pass.draw.kind == dsl::DrawKind::host || pass.dispatch.kind == dsl::DispatchKind::host) return true;
  const auto is_host = [](const dsl::Transfer& transfer) { return transfer.kind == dsl::TransferKind::host; };
  if (std::any_of(pass.transfers.begin(), pass.transfers.end(), is_host)) return true;
  return pass.shaders.empty() && pass.draw.kind == dsl::DrawKind::none && pass.dispatch.kind == dsl::DispatchKind::none && pass.transfers.empty();
}

std::vector<Index> host_slots(const dsl::Graph& graph) {
  std::vector<Index> slots;
  Index next = 0;
  for (const dsl::Pass& pass : graph.passes) slots.push_back(is_host_recorded(pass) ? next++ : kNone);
  return slots;
}

std::vector<Index> import_slots(const dsl::Graph& graph) {
  std::vector<Index> slots;
  Index next = 0;
  for (const dsl::Resource& resource : graph.resources) slots.push_back(resource.lifetime == dsl::Lifetime::imported ? next++ : kNone);
  return slots;
}

std::vector<Index> first_update_slots(const dsl::Graph& graph) {
  std::vector<Index> slots;
  Index next = 0;
  for (const dsl::Pass& pass : graph.passes) {
    slots.push_back(next);
    next += static_cast<Index>(std::count_if(pass.transfers.begin(), pass.transfers.end(),
                                             [](const dsl::Transfer& transfer) { return transfer.kind == dsl::TransferKind::update; }));
  }
  return slots;
}

}  // namespace rg::compiler
