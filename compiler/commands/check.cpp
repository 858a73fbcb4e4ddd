#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/apply_fixes.h"
#include "compiler/commands/command.h"
#include "compiler/commands/files.h"

namespace rg::commands {
namespace {

// Diagnostics of several files in one table of sources.
void append(dsl::Diagnostics& all, dsl::SourceFiles& sources, const dsl::Diagnostics& diagnostics, const dsl::SourceFiles& more) {
  const auto offset = static_cast<uint32_t>(sources.size());
  const auto move = [&](auto&& self, dsl::Diagnostic& diagnostic) -> void {
    for (dsl::Span* span : {&diagnostic.span, &diagnostic.allowed_at})
      if (span->file.valid()) span->file.value += offset;
    for (dsl::FixIt& fix : diagnostic.fixes)
      if (fix.span.file.valid()) fix.span.file.value += offset;
    for (dsl::Diagnostic& note : diagnostic.notes) self(self, note);
  };
  for (dsl::Diagnostic diagnostic : diagnostics.rows()) {
    move(move, diagnostic);
    all.report(std::move(diagnostic));
  }
  for (const dsl::SourceFile& source : more) sources.add(source);
}

struct Checked {
  dsl::Diagnostics diagnostics;
  dsl::SourceFiles sources;
};

Checked check_file(const std::string& path, const compiler::CompileOptions& compile) {
  Checked checked;
  compiler::CompileResult result = compiler::compile(path, reader_for(path), compile, checked.diagnostics);
  checked.sources = std::move(result.sources);
  return checked;
}

size_t count_errors(const dsl::Diagnostics& diagnostics) {
  return static_cast<size_t>(std::count_if(diagnostics.rows().begin(), diagnostics.rows().end(),
                                           [](const dsl::Diagnostic& each) { return each.severity() == dsl::Severity::error; }));
}

// Writes every file that has fixes; false if there was nothing to fix, or a file could not be written.
bool write_fixes(const Checked& checked, dsl::Diagnostics& failures) {
  bool wrote = false;
  for (size_t id = 0; id < checked.sources.size(); ++id) {
    const dsl::FileId file{id};
    const Fixed fixed = apply_fixes(checked.diagnostics, checked.sources, file);
    if (fixed.count == 0) continue;
    if (!write_file(checked.sources[file].path, fixed.text, failures)) return false;
    print(fmt::format("{}: {} applied\n", checked.sources[file].path, counted(fixed.count, "fix", "fixes")));
    wrote = true;
  }
  return wrote;
}

void restore(const Checked& before, dsl::Diagnostics& failures) {
  for (const dsl::SourceFile& source : before.sources) write_file(source.path, source.text, failures);
}

// One fix may uncover the next mistake. What makes matters worse is taken back.
void fix_file(const std::string& path, const compiler::CompileOptions& compile, dsl::Diagnostics& failures) {
  constexpr int kMaxRounds = 16;
  Checked before = check_file(path, compile);
  for (int round = 0; round < kMaxRounds && write_fixes(before, failures); ++round) {
    Checked after = check_file(path, compile);
    if (count_errors(after.diagnostics) > count_errors(before.diagnostics)) return restore(before, failures);
    before = std::move(after);
  }
}

}  // namespace

int check(const CheckOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  compile.progress = show_progress;
  dsl::Diagnostics all;
  dsl::SourceFiles sources;
  all.judge_by(compile.warnings);
  read_profile(compile, all);
  for (const std::string& path : options.files) {
    if (options.fix) fix_file(path, compile, all);
    const Checked checked = check_file(path, compile);
    append(all, sources, checked.diagnostics, checked.sources);
  }
  if (!options.sarif) return finish(all, sources, options.json);
  show_progress({});
  all.sort();
  print(dsl::print_sarif(all, sources));
  return all.has_errors() ? exit_input_wrong : exit_done;
}

}  // namespace rg::commands
