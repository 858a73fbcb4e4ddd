// rgc: compiles a render graph. Exit codes: 0 done, 1 the input is wrong, 2 the call is wrong, 3 our fault.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "compiler/commands/command.h"

namespace {

using namespace rg::commands;

// RG_CHECK has said what went wrong; the exit code says whose fault it is.
void on_abort(int) { std::_Exit(exit_our_fault); }

void install_handlers() {
  std::signal(SIGABRT, on_abort);
  std::signal(SIGXFSZ, SIG_IGN);  // a reached file size limit becomes an error of write()
}

int run_and_flush(const Run& run) {
  const int code = run();
  show_progress({});
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  std::perror("rgc: cannot write to stdout");
  return exit_input_wrong;
}

// CLI11 would only say that a subcommand is missing.
bool names_a_command(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) return true;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return true;
  const auto meant = nearest(word, names);
  std::fprintf(stderr, "rgc: there is no command `%s`%s\n", word.c_str(), meant ? ("; did you mean `" + *meant + "`?").c_str() : "");
  std::fprintf(stderr, "Run with --help for more information.\n");
  return false;
}

int run_command(int argc, char** argv) {
  CLI::App app{"rgc compiles a render graph: .rg files become C++ and SPIR-V.", "rgc"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "rgc 0.1.0");
  app.footer("Exit codes: 0 done, 1 the input is wrong, 2 the call is wrong, 3 our fault.");
  Run run;
  for (auto* add : {add_build, add_check, add_fmt, add_verify, add_explain, add_report, add_graph, add_diff, add_emit}) add(app, run);
  if (argc > 1 && !names_a_command(app, argv[1])) return exit_call_wrong;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_call_wrong;
  }
  return run_and_flush(run);
}

}  // namespace

int main(int argc, char** argv) {
  install_handlers();
  try {
    return run_command(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rgc: internal error: %s\n", error.what());
    return exit_our_fault;
  }
}
