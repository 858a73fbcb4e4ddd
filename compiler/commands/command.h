// What all commands of rgc share: exit codes, options, where text goes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/compile.h"

namespace rg::commands {

enum ExitCode { exit_done = 0, exit_input_wrong = 1, exit_call_wrong = 2, exit_our_fault = 3 };

// Runs after the command line was understood; gives the exit code.
using Run = std::function<int()>;
// Adds one subcommand to `app`; the subcommand sets `run`.
void add_build(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_fmt(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);
void add_explain(CLI::App& app, Run& run);
void add_report(CLI::App& app, Run& run);
void add_graph(CLI::App& app, Run& run);
void add_diff(CLI::App& app, Run& run);
void add_emit(CLI::App& app, Run& run);

// Options that change the plan: -D NAME=VALUE and the work-around switches.
void add_plan_options(CLI::App& command, compiler::CompileOptions& options);

// Prints diagnostics to stderr, in colour on a terminal, or as JSON to stdout. exit_input_wrong if any is an error.
int finish(dsl::Diagnostics& diagnostics, const dsl::SourceFiles& sources, bool json = false);

// compile() from disk with progress on a terminal; nullopt after printing what is wrong.
std::optional<compiler::CompileResult> compile_or_report(const std::string& path, compiler::CompileOptions options);

// Shows what is being worked on in one line of a terminal's stderr that the next call replaces; empty clears it. Does nothing elsewhere.
void show_progress(std::string_view what);

// Text to stdout. main() reports it if stdout could not take everything.
void print(std::string_view text);

// "31 passes", "1 pass".
std::string counted(size_t count, std::string_view noun, std::string_view plural = {});

// The candidate nearest to `name` by edits, if it is near enough to be meant.
std::optional<std::string> nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace rg::commands
