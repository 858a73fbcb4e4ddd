// The commands of rgc as functions, and what they share: exit codes, where text goes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/compile.h"

namespace rg::commands {

enum ExitCode { exit_done = 0, exit_input_wrong = 1, exit_call_wrong = 2, exit_our_fault = 3 };

// ---- the commands: options as plain values, the exit code as the result -------------------------------------------------

struct BuildOptions {
  std::string file, folder = "generated", depfile, stamp, manifest, plan_file;
  bool quiet = false;
  compiler::CompileOptions compile;
};
struct WatchOptions {
  std::string file, plan_file, folder;  // of generated files; empty: none
  bool quiet = false;
  compiler::CompileOptions compile;
};
struct CheckOptions {
  std::vector<std::string> files;
  bool json = false, sarif = false, fix = false;
  compiler::CompileOptions compile;
};
struct FmtOptions {
  std::vector<std::string> files;
  bool check = false;
};
struct VerifyCommand {
  std::string file;
  bool mutate = false, ask_all = false;
  compiler::CompileOptions compile;
};
struct ExplainOptions {
  std::string file_or_code, name;
  bool codes = false;
  compiler::CompileOptions compile;
};
struct ReportOptions {
  std::string file;
  bool json = false;
  compiler::CompileOptions compile;
};
struct StatsOptions {
  std::string file;
  bool json = false;
  compiler::CompileOptions compile;
};
struct SpectrumCommand {
  std::string file, html;
  bool json = false;
  compiler::CompileOptions compile;
};
struct GraphOptions {
  std::string file;
  bool dot = false, html = false;
  compiler::CompileOptions compile;
};
struct DiffOptions {
  std::string before, after;
  compiler::CompileOptions compile;
};
struct EmitOptions {
  std::string stage, file;
  compiler::CompileOptions compile;
};
int build(const BuildOptions& options);
int watch(const WatchOptions& options);
int check(const CheckOptions& options);
int format_files(const FmtOptions& options);
int verify_file(const VerifyCommand& options);
int explain(const ExplainOptions& options);
int report(const ReportOptions& options);
int stats(const StatsOptions& options);
int spectrum(const SpectrumCommand& options);
int show_graph(const GraphOptions& options);
int diff(const DiffOptions& options);
int emit(const EmitOptions& options);
std::vector<std::string> emit_stages();

// ---- what they share ---------------------------------------------------------------------------------------------------

// Prints diagnostics to stderr, in colour on a terminal, or as JSON to stdout. exit_input_wrong if any is an error.
int finish(dsl::Diagnostics& diagnostics, const dsl::SourceFiles& sources, bool json = false);

// Fills CompileOptions::profile_text; warns and forgets the profile where it cannot be read.
void read_profile(compiler::CompileOptions& options, dsl::Diagnostics& diagnostics);

// compile() from disk with progress on a terminal; nullopt after printing what is wrong.
std::optional<compiler::CompileResult> compile_or_report(const std::string& path, compiler::CompileOptions options);

// The plans of all graphs as data, see compiler/codegen/plan_file.h, to be written to `path`, which is not relative to the output folder.
compiler::GeneratedFile plan_file(const std::string& path, const compiler::CompileResult& result);

// Shows what is being worked on in one line of a terminal's stderr that the next call replaces; empty clears it. Does nothing elsewhere.
void show_progress(std::string_view what);

// Text to stdout. main() reports it if stdout could not take everything.
void print(std::string_view text);

// "31 passes", "1 pass".
std::string counted(size_t count, std::string_view noun, std::string_view plural = {});

// Those of the candidates that `name` may be a slip of, to stand between backquotes ("a` or `b").
std::optional<std::string> nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace rg::commands
