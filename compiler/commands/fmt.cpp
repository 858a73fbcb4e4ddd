#include <fmt/format.h>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "dsl/format.h"

namespace rg::commands {
namespace {

// One file; whatever is wrong is reported, and then the file stays as it is.
void format_file(const std::string& path, bool check, dsl::SourceFiles& sources, dsl::Diagnostics& diagnostics) {
  std::string why;
  const auto text = read_file(path, why);
  if (!text) {
    diagnostics.report(dsl::DiagnosticKind::FileNotReadable, {}, {path, why});
    return;
  }
  const dsl::FileId file = sources.add(dsl::SourceFile(path, *text));
  const auto formatted = dsl::format(file, sources[file].text, diagnostics);
  if (!formatted || *formatted == *text) return;
  if (check)
    diagnostics.report(dsl::DiagnosticKind::NotFormatted, {}, {path});
  else if (write_file(path, *formatted, diagnostics))
    print(fmt::format("formatted {}\n", path));
}

}  // namespace

int format_files(const FmtOptions& options) {
  dsl::SourceFiles sources;
  dsl::Diagnostics diagnostics;
  for (const std::string& path : options.files) format_file(path, options.check, sources, diagnostics);
  return finish(diagnostics, sources);
}

}  // namespace rg::commands
