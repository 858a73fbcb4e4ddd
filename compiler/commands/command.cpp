#include "compiler/commands/command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "compiler/commands/files.h"
#include "dsl/closest.h"

namespace rg::commands {
namespace {

bool wants_colour() { return ::isatty(STDERR_FILENO) && !std::getenv("NO_COLOR"); }

}  // namespace

int finish(dsl::Diagnostics& diagnostics, const dsl::SourceFiles& sources, bool json) {
  show_progress({});
  diagnostics.sort();
  if (json)
    print(dsl::print_json(diagnostics, sources));
  else
    fmt::print(stderr, "{}", dsl::print(diagnostics, sources, wants_colour()));
  return diagnostics.has_errors() ? exit_input_wrong : exit_done;
}

void read_profile(compiler::CompileOptions& options, dsl::Diagnostics& diagnostics) {
  if (options.profile.empty()) return;
  std::string why;
  const std::optional<std::string> text = read_file(options.profile, why);
  if (!text) diagnostics.report(dsl::DiagnosticKind::ProfileIgnored, {}, {options.profile, why});
  if (!text) options.profile.clear();
  options.profile_text = text.value_or("");
}

std::optional<compiler::CompileResult> compile_or_report(const std::string& path, compiler::CompileOptions options) {
  dsl::Diagnostics diagnostics;
  options.progress = show_progress;
  read_profile(options, diagnostics);
  compiler::CompileResult result = compiler::compile(path, reader_for(path), options, diagnostics);
  if (!diagnostics.has_errors() && result.program.graphs.empty()) diagnostics.report(dsl::DiagnosticKind::NoGraph, {}, {path});
  if (finish(diagnostics, result.sources) != exit_done) return std::nullopt;
  return result;
}

void show_progress(std::string_view what) {
  static const bool terminal = ::isatty(STDERR_FILENO);
  if (terminal) fmt::print(stderr, "\r\033[K{}", what);
}

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string counted(size_t count, std::string_view noun, std::string_view plural) {
  if (count == 1) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", count, noun) : fmt::format("{} {}", count, plural);
}

std::optional<std::string> nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string meant = dsl::closest(name, {candidates.begin(), candidates.end()}).shown();
  return meant.empty() ? std::nullopt : std::optional(meant);
}

}  // namespace rg::commands
