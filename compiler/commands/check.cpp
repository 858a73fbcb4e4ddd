#include "compiler/commands/command.h"
#include "compiler/commands/files.h"

namespace rg::commands {
namespace {

// Diagnostics of several files in one table of sources.
void append(dsl::Diagnostics& all, dsl::SourceFiles& sources, const dsl::Diagnostics& diagnostics, const dsl::SourceFiles& more) {
  const auto offset = static_cast<uint32_t>(sources.size());
  const auto move = [&](auto&& self, dsl::Diagnostic& diagnostic) -> void {
    if (diagnostic.span.file.valid()) diagnostic.span.file.value += offset;
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

}  // namespace

int check(const CheckOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  compile.progress = show_progress;
  dsl::Diagnostics all;
  dsl::SourceFiles sources;
  read_profile(compile, all);
  for (const std::string& path : options.files) {
    dsl::Diagnostics diagnostics;
    const compiler::CompileResult result = compiler::compile(path, reader_for(path), compile, diagnostics);
    append(all, sources, diagnostics, result.sources);
  }
  return finish(all, sources, options.json);
}

}  // namespace rg::commands
