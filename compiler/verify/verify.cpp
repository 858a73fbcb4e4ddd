#include "compiler/verify/verify.h"

#include <set>

#include "compiler/verify/alias.h"
#include "compiler/verify/boundary.h"
#include "compiler/verify/contents.h"
#include "compiler/verify/model.h"
#include "compiler/verify/redundancy.h"
#include "compiler/verify/report.h"
#include "compiler/verify/structure.h"
#include "compiler/verify/sync_replay.h"
#include "compiler/verify/work.h"

namespace rg::verify {
namespace {

void prove(const Input& input, const std::vector<int64_t>& extents, std::vector<Partition> partitions, const VerifyOptions& options, Report& report) {
  const Model model = make_model(input, extents, std::move(partitions), report);
  check_usage(model, report);
  check_work(model, extents, report);
  check_boundaries(model, report);
  const SyncResult sync = replay_sync(model, model.history + 2, options.irredundancy, report);
  check_aliases(model, sync, report);
  replay_contents(model, extents, report);
  // Redundancy of a plan that is wrong means nothing.
  if (!options.irredundancy || !report.empty()) return;
  check_redundancy(model, sync.required, report);
  check_release_redundancy(model, sync, report);
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
