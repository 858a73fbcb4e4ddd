#include "compiler/commands/command.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
int show_graph(const GraphOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  for (const compiler::CompiledGraph& graph : result->graphs)
    print(options.dot ? graph_dot(result->program, graph) : graph_text(result->program, result->program.graphs[graph.graph]));
  return exit_done;
}

}  // namespace rg::commands
