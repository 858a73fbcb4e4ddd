#include "compiler/fusion/fusion_figures.h"

#include <algorithm>

#include "dsl/format_table.h"

namespace rg::compiler {
namespace {

const dsl::Pass* find_pass(const dsl::Graph& graph, const std::string& name) {
  const auto found = std::find_if(graph.passes.begin(), graph.passes.end(), [&](const dsl::Pass& pass) { return pass.name == name; });
  return found == graph.passes.end() ? nullptr : &*found;
}

uint64_t elements(const dsl::Program& program, const dsl::Pass& pass, const std::vector<int64_t>& extents) {
  uint64_t count = 1;
  for (const dsl::ExprId size : pass.dispatch.size) count *= static_cast<uint64_t>(dsl::evaluate(program, size, extents));
  return count;
}

uint64_t bytes_of(const dsl::Resource& resource) {
  return resource.kind == dsl::ResourceKind::image ? dsl::info(resource.format).block_bytes : resource.stride;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "`" : i + 1 == names.size() ? " and `" : ", `") + names[i] + "`";
  return text;
}

std::string megabytes(uint64_t bytes) {
  const uint64_t tenths = (bytes + 50000) / 100000;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MB";
}

std::string gain(const dsl::Program& written, const FusedKernel& kernel) {
  const FusionFigures figures = fusion_figures(written, kernel, dsl::initial_extents(written));
  return megabytes(figures.moved) + " a frame are not moved and " + megabytes(figures.memory) + " not held, at the initial extents";
}

}  // namespace

FusionFigures fusion_figures(const dsl::Program& written, const FusedKernel& kernel, const std::vector<int64_t>& extents) {
  FusionFigures figures;
  const dsl::Graph& graph = written.graphs[kernel.graph];
  const dsl::Pass* first = find_pass(graph, kernel.members.front());
  if (first == nullptr) return figures;
  const uint64_t count = elements(written, *first, extents);
  for (const FusedKernel::Saved& saved : kernel.saved) {
    const uint64_t bytes = count * bytes_of(graph.resources[saved.resource]);
    figures.moved += bytes * saved.accesses;
    figures.memory += saved.dropped ? bytes : 0;
  }
  return figures;
}

uint64_t element_bytes(const dsl::Program& written, dsl::GraphId id, const std::vector<std::string>& names, const std::vector<int64_t>& extents) {
  const dsl::Graph& graph = written.graphs[id];
  uint64_t bytes = 0;
  for (const std::string& name : names) {
    const dsl::Pass* pass = find_pass(graph, name);
    if (pass == nullptr) continue;
    for (const dsl::Access& access : pass->accesses)
      if (access.element)
        bytes += elements(written, *pass, extents) * bytes_of(graph.resources[access.resource]) * (access.mode == dsl::Mode::update ? 2 : 1);
  }
  return bytes;
}

std::vector<FusionNote> fusion_notes(const dsl::Program& written, const std::vector<FusedKernel>& kernels, const std::vector<FusionRefusal>& refusals,
                                     dsl::GraphId graph) {
  std::vector<FusionNote> notes;
  for (const FusedKernel& kernel : kernels) {
    if (kernel.graph != graph) continue;
    notes.push_back({kernel.pass, "fused", "one kernel of " + list(kernel.members) + "; " + gain(written, kernel)});
    for (const std::string& member : kernel.members)
      notes.push_back({member, "runs in `" + kernel.pass + "`", "`fuse " + kernel.fusion + "` merges it"});
    for (const FusedKernel::Saved& saved : kernel.saved) {
      const std::string& name = written.graphs[graph].resources[saved.resource].name;
      if (saved.dropped) notes.push_back({name, "stays in registers", "nothing but kernel `" + kernel.pass + "` writes or reads it"});
    }
  }
  for (const FusionRefusal& refusal : refusals)
    if (refusal.graph == graph) notes.push_back({refusal.pass, "stays apart in `fuse " + refusal.fusion + "`", refusal.reason});
  return notes;
}

}  // namespace rg::compiler
