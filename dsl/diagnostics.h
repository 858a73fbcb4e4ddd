// Diagnostics are data: a registered kind, a place, arguments, notes with their own places, fixes. Phases append; only the command line prints.
#pragma once

#include <optional>
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
std::optional<DiagnosticKind> kind_of_code(std::string_view code);

struct FixIt {  // replaces `span` by `text`
  Span span;
  std::string text;
  friend bool operator==(const FixIt&, const FixIt&) = default;
};
// What somebody has said about a warning beforehand.
enum class Standing : uint8_t { as_registered, denied, allowed_here, allowed_outside };  // outside: on the command line
struct Diagnostic {
  DiagnosticKind kind{};
  Span span;
  std::vector<std::string> arguments;
  std::vector<Diagnostic> notes;
  std::vector<FixIt> fixes;
  Standing standing = Standing::as_registered;
  Span allowed_at;  // what allows it here

  Diagnostic() = default;
  Diagnostic(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  Diagnostic& note(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  Diagnostic& fix(Span span, std::string text);
  std::string message() const;  // of the registry, arguments filled in
  Severity severity() const { return standing == Standing::denied ? Severity::error : row(kind).severity; }
  bool allowed() const { return standing == Standing::allowed_here || standing == Standing::allowed_outside; }
};

struct Allowance {  // `allow RG0388`: warnings of this kind whose place is in `scope` are known
  DiagnosticKind kind{};
  Span scope, at;
};
struct WarningPolicy {  // of the command line; what a file allows, no command line denies
  std::vector<DiagnosticKind> allowed, denied;
};

class Diagnostics {
 public:
  Diagnostic& report(Diagnostic diagnostic);  // the reference is valid until the next report
  Diagnostic& report(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {});
  void replace_last(Diagnostic diagnostic) { rows_.back() = std::move(diagnostic); }  // with one that has more notes
  void allow(std::vector<Allowance> allowances);
  void judge_by(WarningPolicy policy);
  // Says how the diagnostic would stand if it were reported. O(log allowances).
  void judge(Diagnostic& diagnostic) const;
  bool has_errors() const;  // warnings that are denied are errors
  const std::vector<Diagnostic>& rows() const { return rows_; }
  std::vector<Allowance> useless() const;  // those that no warning needs
  void sort();                             // by file, place, code; drops exact repeats
  void drop_repeats();                     // keeps the first of each kind at each place

 private:
  std::vector<Diagnostic> rows_;
  std::vector<Allowance> allowances_;  // by kind, file and where their scopes begin
  std::vector<size_t> widest_;         // by allowance: of those of its kind and file up to it, the one whose scope ends last
  WarningPolicy policy_;
};

// At most `most` errors and as many others, in their order; behind them, where some are missing, a note that says how many. What is allowed is for
// programs.
std::vector<Diagnostic> first_of(const Diagnostics& diagnostics, size_t most, bool with_allowed);
constexpr size_t kMostForPeople = 100, kMostForPrograms = 1000;

// Text with snippet, caret and notes; colour by ANSI codes where wanted. At most kMostForPeople errors; nothing that is allowed.
std::string print(const Diagnostics& diagnostics, const SourceFiles& files, bool colour);
// The documented JSON form, first_of(diagnostics, kMostForPrograms): an array of {code, name, severity, message, file, line, column, end_line,
// end_column, notes, fixes}, with `suppressions` where a warning is allowed.
std::string print_json(const Diagnostics& diagnostics, const SourceFiles& files);
// SARIF 2.1.0 (OASIS) of as many, one run: rules are the codes that occur, notes with a place are related locations. Columns count code points
// from 1.
std::string print_sarif(const Diagnostics& diagnostics, const SourceFiles& files);

}  // namespace rg::dsl
