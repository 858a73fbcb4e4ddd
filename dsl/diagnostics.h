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

// At most `most` errors and as many others, in their order; behind them, where some are missing, a note that says how many.
std::vector<Diagnostic> first_of(const Diagnostics& diagnostics, size_t most);
constexpr size_t kMostForPeople = 100, kMostForPrograms = 1000;

// Text with snippet, caret and notes; colour by ANSI codes where wanted. At most kMostForPeople errors.
std::string print(const Diagnostics& diagnostics, const SourceFiles& files, bool colour);
// The documented JSON form, first_of(diagnostics, kMostForPrograms): an array of {code, name, severity, message, file, line, column, end_line, end_column, notes, fixes}.
std::string print_json(const Diagnostics& diagnostics, const SourceFiles& files);
// SARIF 2.1.0 (OASIS) of as many, one run: rules are the codes that occur, notes with a place are related locations. Columns count bytes from 1.
std::string print_sarif(const Diagnostics& diagnostics, const SourceFiles& files);

}  // namespace rg::dsl
