#include <fmt/format.h>

#include <algorithm>

#include "compiler/expressions.h"
#include "compiler/frame.h"
#include "compiler/profiles.h"

namespace rg::compiler {
namespace {

constexpr const char* kLimit = "maxMemoryAllocationSize";

// What every profile promises; without one, what every device has.
double most_in_one_piece(const dsl::Program& program) {
  double most = program.profiles.empty() ? limit_of({}, kLimit) : limit_of(*program.profiles.begin(), kLimit);
  for (const dsl::Profile& profile : program.profiles) most = std::min(most, limit_of(profile, kLimit));
  return most;
}

const dsl::Pass* first_user(const dsl::Graph& graph, uint32_t resource) {
  const auto uses = [&](const dsl::Pass& pass) {
    return std::any_of(pass.accesses.begin(), pass.accesses.end(), [&](const dsl::Access& access) { return access.resource.value == resource; });
  };
  const auto found = std::find_if(graph.passes.begin(), graph.passes.end(), uses);
  return found == graph.passes.end() ? nullptr : &*found;
}

std::string gibibytes(double bytes) { return fmt::format("{:.4g} GiB", bytes / (1024.0 * 1024 * 1024)); }

}  // namespace

void judge_memory(const dsl::Program& program, dsl::GraphId graph_id, dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  const double most = most_in_one_piece(program);
  const std::vector<Expr> exprs = convert_expressions(program);
  const std::vector<int64_t> extents = dsl::maximum_extents(program);
  for (uint32_t r = 0; r < graph.resources.size(); ++r) {
    const dsl::Resource& resource = graph.resources.rows[r];
    if (resource.lifetime == dsl::Lifetime::imported) continue;
    const auto bytes = static_cast<double>(bytes_of(resource, exprs, extents));
    if (bytes <= most) continue;
    const dsl::Pass* user = first_user(graph, r);
    if (!user) continue;
    const char* kind = resource.kind == dsl::ResourceKind::image ? "image" : "buffer";
    const std::string way_out =
        fmt::format("pass `{}` uses it first: make it smaller or several, or name a target profile with a greater `{}`", user->name, kLimit);
    diagnostics.report(dsl::DiagnosticKind::NoMemoryHolds, resource.span, {kind, resource.name, gibibytes(bytes), gibibytes(most), way_out});
  }
}

}  // namespace rg::compiler
