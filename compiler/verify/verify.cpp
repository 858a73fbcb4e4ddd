#include "compiler/verify/verify.h"

#include <algorithm>
#include <map>
#include <set>

#include "compiler/verify/alias.h"
#include "compiler/verify/boundary.h"
#include "compiler/verify/contents.h"
#include "compiler/verify/model.h"
#include "compiler/verify/redundancy.h"
#include "compiler/verify/release_track.h"
#include "compiler/verify/report.h"
#include "compiler/verify/structure.h"
#include "compiler/verify/submission.h"
#include "compiler/verify/sync_replay.h"
#include "compiler/verify/work.h"

namespace rg::verify {
namespace {

using Families = std::vector<uint32_t>;  // by queue

// One family a kind of queue.
Families families_of(const Plan& plan) {
  Families families;
  for (const Queue& queue : plan.queues) families.push_back(static_cast<uint32_t>(queue.kind));
  return families;
}

bool has_transfers(const Plan& plan) {
  const auto transfers = [](const auto& barrier) { return barrier.src_queue != barrier.dst_queue; };
  return std::any_of(plan.image_barriers.begin(), plan.image_barriers.end(), transfers) ||
         std::any_of(plan.buffer_barriers.begin(), plan.buffer_barriers.end(), transfers);
}

// visit(families) for the devices where kinds of queues share a family, so that transfers are not recorded: two kinds, or all.
void for_each_union(const Plan& plan, auto visit) {
  if (!has_transfers(plan)) return;
  const Families apart = families_of(plan);
  std::set<Families> seen{apart};
  for (uint32_t a = 0; a < 3; ++a)
    for (uint32_t b = 0; b <= 3; ++b) {
      Families united = apart;
      for (uint32_t& family : united)
        if (b == 3 || family == b) family = a;
      if (seen.insert(united).second) visit(united);
    }
}

void prove_united(const Input& input, const std::vector<int64_t>& extents, const std::vector<Partition>& partitions, Report& report) {
  for_each_union(input.plan, [&](const Families& united) {
    if (!report.full()) replay_sync(make_model(input, extents, partitions, united, report), false, report);
  });
}

// What only a device with fewer families needs is needed, too.
void require_united(const Input& input, const std::vector<int64_t>& extents, const std::vector<Partition>& partitions, const Model& model,
                    std::vector<bool>& required, Report& report) {
  std::map<std::pair<ScopeKind, uint32_t>, uint32_t> scope_of_row;
  for (uint32_t id = 0; id < model.scopes.size(); ++id) scope_of_row[{model.scopes[id].kind, model.scopes[id].index}] = id;
  for_each_union(input.plan, [&](const Families& united) {
    const Model other = make_model(input, extents, partitions, united, report);
    const SyncResult result = replay_sync(other, true, report);
    for (Atom atom = 0; atom < result.required.size(); ++atom) {
      if (!result.required[atom]) continue;
      const Scope& scope = other.scopes[scope_of(atom)];
      required[scope_of_row.at({scope.kind, scope.index}) * kAtomsOfScope + atom % kAtomsOfScope] = true;
    }
  });
}

// Redundancy of a plan that is wrong means nothing.
void find_redundancy(const Input& input, const std::vector<int64_t>& extents, const std::vector<Partition>& partitions, const Model& model,
                     SyncResult& sync, Report& report) {
  require_declared_order(model, sync.required);
  Report apart(1);
  check_redundancy(model, extents, sync.required, apart);
  if (!apart.empty()) require_united(input, extents, partitions, model, sync.required, report);
  check_redundancy(model, extents, sync.required, report);
  check_release_redundancy(model, sync.released, report);
}

void prove(const Input& input, const std::vector<int64_t>& extents, std::vector<Partition> partitions, const VerifyOptions& options, Report& report) {
  const Model model = make_model(input, extents, partitions, families_of(input.plan), report);
  check_usage(model, report);
  check_submission(model, report);
  check_work(model, extents, report);
  check_boundaries(model, report);
  SyncResult sync = replay_sync(model, options.irredundancy, report);
  prove_united(input, extents, partitions, report);
  check_aliases(model, sync, report);
  replay_contents(model, extents, report);
  if (options.irredundancy && report.empty()) find_redundancy(input, extents, partitions, model, sync, report);
}

}  // namespace

std::vector<Finding> verify(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
                            const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource, const VerifyOptions& options) {
  Report report(options.max_findings);
  const Input input{program, program.graphs[graph], configuration, plan, program_pass, program_resource};
  if (!check_indices(input, report)) return report.take();
  std::vector<std::vector<int64_t>> samples = options.extents;
  samples.insert(samples.begin(), dsl::maximum_extents(program));
  samples.insert(samples.begin(), dsl::initial_extents(program));
  // The proof depends on extents only through the cut into cells.
  std::set<std::vector<uint32_t>> proved;
  for (const std::vector<int64_t>& extents : samples) {
    Cut cut = make_cut(input, extents);
    if (!proved.insert(std::move(cut.ranks)).second) continue;
    prove(input, extents, std::move(cut.partitions), options, report);
    if (!report.empty()) break;
  }
  return report.take();
}

}  // namespace rg::verify
