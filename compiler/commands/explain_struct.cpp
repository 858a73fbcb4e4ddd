#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/explain.h"
#include "compiler/commands/plan_text.h"
#include "dsl/layout.h"
#include "dsl/print.h"

namespace rg::commands {
namespace {

std::string field_line(const dsl::Program& program, const dsl::Field& field, uint64_t scalar_offset, size_t width) {
  return fmt::format("  {:<{}}  {:>8}  {:>8}  {:>8}\n", field.name + ": " + dsl::print_type(program, field.type), width, field.offset140,
                     field.offset430, scalar_offset);
}

std::string layout_table(const dsl::Program& program, const dsl::Struct& record) {
  size_t width = 12;
  for (const dsl::Field& field : record.fields) width = std::max(width, field.name.size() + 2 + dsl::print_type(program, field.type).size());
  std::string text = fmt::format("  {:<{}}  {:>8}  {:>8}  {:>8}\n", "offset of", width, "std140", "std430", "scalar");
  uint64_t scalar = 0;
  for (const dsl::Field& field : record.fields) {
    text += field_line(program, field, scalar, width);
    scalar += dsl::scalar_size(program.structs, field.type);
  }
  text += fmt::format("  {:<{}}  {:>8}  {:>8}  {:>8}\n", "size", width, record.size140, record.size430, scalar);
  return text + fmt::format("  {:<{}}  {:>8}  {:>8}  {:>8}\n", "alignment", width, record.align140, record.align430, 4);
}

// Where blocks of the struct stand, and so which of the layouts counts.
std::string uses_of(const dsl::Program& program, dsl::StructId id) {
  std::string text;
  for (const dsl::Graph& graph : program.graphs) {
    for (const dsl::Params& params : graph.params)
      if (params.type == id)
        text += fmt::format("  std140  params {}{}\n", params.name,
                            params.pass.valid() ? " of pass " + graph.passes[params.pass].name : " of graph " + graph.name);
    for (const dsl::Pass& pass : graph.passes) {
      if (pass.draw.per_draw == id) text += fmt::format("  std430  push constants of pass {}\n", pass.name);
      for (const dsl::Access& access : pass.accesses)
        if (graph.resources[access.resource].element.record == id && (access.role == dsl::Role::uniform || access.role == dsl::Role::storage))
          text += fmt::format("  {}  buffer {} in pass {}\n", access.role == dsl::Role::uniform ? "std140" : "std430",
                              graph.resources[access.resource].name, pass.name);
    }
  }
  return text;
}

}  // namespace

std::string explain_struct(const dsl::Program& program, const dsl::SourceFiles& sources, const std::string& name) {
  for (size_t id = 0; id < program.structs.size(); ++id) {
    const dsl::Struct& record = program.structs.rows[id];
    if (record.name != name) continue;
    const bool agree = dsl::layouts_agree(program.structs, record);
    return fmt::format("struct {}  {}\n", record.name, place_text(sources, record.span)) + layout_table(program, record) +
           (dsl::is_scalar(record) ? "  declared scalar: its blocks and all it holds are laid out without padding\n"
            : agree                ? "  std140 and std430 agree: one C++ struct fits uniform and storage blocks\n"
                                   : "  std140 and std430 differ: C++ has a struct for the one in use\n") +
           uses_of(program, dsl::StructId{id});
  }
  return {};
}

}  // namespace rg::commands
