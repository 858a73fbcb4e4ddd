// Diagnostics are data: a registered kind, a place, arguments, notes with their own places, fixes. Phases append; only the command line prints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dsl/source.h"

namespace rg::dsl {

enum class Severity : uint8_t { error, warning, note };
enum class DiagnosticKind : uint16_t {
#define RG_DIAGNOSTIC(name, ...) name,
#include "dsl/diagnostic_kind.def"
#undef RG_DIAGNOSTIC
};
struct DiagnosticRow {
  std::string_view name, code;
  Severity severity = Severity::error;
  std::string_view message;
};
const DiagnosticRow& row(DiagnosticKind kind);
std::vector<DiagnosticKind> all_diagnostic_kinds();

struct FixIt {  // replaces `span` by `text`
  Span span;
  std::string text;
  friend bool operator==(const FixIt&, const FixIt&) = default;
};
struct Diagnostic {
  DiagnosticKind kind{};
  Span span;
  std::vector<std::string> arguments;
  std::vector<Diagnostic> notes;
  std::vector<FixIt> fixes;

  Diagnostic() = default;
  Diagnostic(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  Diagnostic& note(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  Diagnostic& fix(Span span, std::string text);
  std::string message() const;  // of the registry, arguments filled in
};

class Diagnostics {
 public:
  Diagnostic& report(Diagnostic diagnostic);  // the reference is valid until the next report
  Diagnostic& report(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  void replace_last(Diagnostic diagnostic) { rows_.back() = std::move(diagnostic); }  // with one that has more notes
  bool has_errors() const;
  const std::vector<Diagnostic>& rows() const { return rows_; }
  void sort();  // by file, place, code; drops exact repeats

 private:
  std::vector<Diagnostic> rows_;
};

// Text with snippet, caret and notes; colour by ANSI codes where wanted.
std::string print(const Diagnostics& diagnostics, const SourceFiles& files, bool colour);
// The documented JSON form: an array of {code, name, severity, message, file, line, column, end_line, end_column, notes, fixes}.
std::string print_json(const Diagnostics& diagnostics, const SourceFiles& files);

}  // namespace rg::dsl
