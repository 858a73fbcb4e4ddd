// Facts about a whole graph: what is never used, structs that two kinds of blocks lay out differently.
#include "dsl/check_state.h"
#include "dsl/layout.h"

namespace rg::dsl {
namespace {

struct Uses {
  std::optional<Span> uniform, storage;
};

std::string first_difference(const Table<StructId, Struct>& structs, const Struct& record) {
  for (const Field& field : record.fields) {
    if (field.offset140 != field.offset430) return field.name;
    const bool nested = field.type.record.valid() && !layouts_agree(structs, structs[field.type.record]);
    const uint64_t size140 = layout_of(structs, field.type, BlockLayout::std140).size,
                   size430 = layout_of(structs, field.type, BlockLayout::std430).size;
    if (nested || size140 != size430) return field.name;
  }
  return record.name;
}

void note_use(std::vector<Uses>& uses, StructId record, bool uniform, Span span) {
  if (!record.valid()) return;
  auto& slot = uniform ? uses[record.value].uniform : uses[record.value].storage;
  if (!slot) slot = span;
}

std::vector<Uses> collect_uses(const Checker& checker, const Graph& graph) {
  std::vector<Uses> uses(checker.program.structs.size());
  for (const Params& params : graph.params) note_use(uses, params.type, true, params.span);
  for (const Pass& pass : graph.passes)
    for (const Access& access : pass.accesses) {
      const Resource& resource = graph.resources[access.resource];
      if (resource.kind != ResourceKind::buffer) continue;
      const bool in_shader = access.role == Role::uniform || access.role == Role::storage;
      if (in_shader) note_use(uses, resource.element.record, access.role == Role::uniform, access.span);
    }
  return uses;
}

}  // namespace

void check_block_layouts(Checker& checker, const Graph& graph) {
  const std::vector<Uses> uses = collect_uses(checker, graph);
  for (size_t id = 0; id < uses.size(); ++id) {
    const Struct& record = checker.program.structs[StructId{id}];
    if (!uses[id].uniform || !uses[id].storage || layouts_agree(checker.program.structs, record)) continue;
    checker.report(DiagnosticKind::LayoutsDiffer, *uses[id].uniform, {record.name, first_difference(checker.program.structs, record)})
        .note(DiagnosticKind::UsedAsStorage, *uses[id].storage)
        .note(DiagnosticKind::DeclaredHere, record.span, {record.name});
  }
}

void check_unused(Checker& checker, const GraphScope& scope) {
  for (size_t id = 0; id < scope.graph.resources.size(); ++id) {
    const Resource& resource = scope.graph.resources.rows[id];
    const bool of_interface = resource.lifetime == Lifetime::imported && !resource.is_surface;
    if (!scope.resource_used[id] && !of_interface) checker.report(DiagnosticKind::UnusedResource, resource.span, {resource.name});
  }
}

}  // namespace rg::dsl
