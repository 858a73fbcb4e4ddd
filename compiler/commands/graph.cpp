#include <memory>

#include "compiler/commands/command.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
namespace {

struct GraphOptions {
  std::string file;
  bool dot = false;
  compiler::CompileOptions compile;
};

int show_graph(const GraphOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  for (const compiler::CompiledGraph& graph : result->graphs)
    print(options.dot ? graph_dot(result->program, graph) : graph_text(result->program, result->program.graphs[graph.graph]));
  return exit_done;
}

}  // namespace

void add_graph(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("graph", "passes and the resources between them");
  auto options = std::make_shared<GraphOptions>();
  command->add_option("FILE", options->file, "the root .rg file")->required();
  command->add_flag("--dot", options->dot, "for Graphviz");
  add_plan_options(*command, options->compile);
  command->callback([=, &run] { run = [=] { return show_graph(*options); }; });
}

}  // namespace rg::commands
