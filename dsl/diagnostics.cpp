#include "dsl/diagnostics.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "dsl/check_macro.h"

namespace rg::dsl {
namespace {

constexpr auto error = Severity::error;
constexpr auto warning = Severity::warning;
[[maybe_unused]] constexpr auto note = Severity::note;

constexpr DiagnosticRow kRows[] = {
#define RG_DIAGNOSTIC(name, code, severity, message) {#name, code, severity, message},
#include "dsl/diagnostic_kind.def"
#undef RG_DIAGNOSTIC
};

auto place(DiagnosticKind kind, const Span& span) { return std::make_tuple(kind, span.file.value, span.begin); }
auto begin_of(const Allowance& allowance) { return place(allowance.kind, allowance.scope); }
bool are_of_one_file(const Allowance& a, DiagnosticKind kind, const Span& span) { return a.kind == kind && a.scope.file == span.file; }

auto key(const Diagnostic& d) { return std::make_tuple(d.span.file.value, d.span.begin, d.span.end, row(d.kind).code, std::cref(d.arguments)); }

}  // namespace

const DiagnosticRow& row(DiagnosticKind kind) { return kRows[static_cast<size_t>(kind)]; }

std::vector<DiagnosticKind> all_diagnostic_kinds() {
  std::vector<DiagnosticKind> kinds;
  for (size_t i = 0; i < std::size(kRows); ++i) kinds.push_back(static_cast<DiagnosticKind>(i));
  return kinds;
}

std::optional<DiagnosticKind> kind_of_code(std::string_view code) {
  for (size_t i = 0; i < std::size(kRows); ++i)
    if (kRows[i].code == code) return static_cast<DiagnosticKind>(i);
  return std::nullopt;
}

Diagnostic::Diagnostic(DiagnosticKind kind_, Span span_, std::vector<std::string> arguments_)
    : kind(kind_), span(span_), arguments(std::move(arguments_)) {}

Diagnostic& Diagnostic::note(DiagnosticKind note_kind, Span note_span, std::vector<std::string> note_arguments) {
  notes.emplace_back(note_kind, note_span, std::move(note_arguments));
  return *this;
}

Diagnostic& Diagnostic::fix(Span fix_span, std::string text) {
  fixes.push_back({fix_span, std::move(text)});
  return *this;
}

std::string Diagnostic::message() const {
  std::string text;
  const std::string_view pattern = row(kind).message;
  for (size_t at = 0; at < pattern.size(); ++at) {
    const bool slot = pattern[at] == '{' && at + 2 < pattern.size() && pattern[at + 2] == '}';
    if (!slot) {
      text += pattern[at];
      continue;
    }
    const auto index = static_cast<size_t>(pattern[at + 1] - '0');
    RG_CHECK(index < arguments.size(), "a diagnostic lacks an argument of its message");
    text += arguments[index];
    at += 2;
  }
  return text;
}

// What a file says goes before what the command line says.
void Diagnostics::judge(Diagnostic& diagnostic) const {
  if (row(diagnostic.kind).severity != Severity::warning) return;
  const auto names = [&](const std::vector<DiagnosticKind>& kinds) { return std::find(kinds.begin(), kinds.end(), diagnostic.kind) != kinds.end(); };
  const auto later = std::upper_bound(allowances_.begin(), allowances_.end(), place(diagnostic.kind, diagnostic.span),
                                      [](const auto& at, const Allowance& each) { return at < begin_of(each); });
  const Allowance* known = later == allowances_.begin() ? nullptr : &allowances_[widest_[static_cast<size_t>(later - allowances_.begin()) - 1]];
  if (known && are_of_one_file(*known, diagnostic.kind, diagnostic.span) && diagnostic.span.end <= known->scope.end)
    diagnostic.standing = Standing::allowed_here, diagnostic.allowed_at = known->at;
  else if (names(policy_.allowed))
    diagnostic.standing = Standing::allowed_outside;
  else if (names(policy_.denied))
    diagnostic.standing = Standing::denied;
}

Diagnostic& Diagnostics::report(Diagnostic diagnostic) {
  judge(diagnostic);
  return rows_.emplace_back(std::move(diagnostic));
}
Diagnostic& Diagnostics::report(DiagnosticKind kind, Span span, std::vector<std::string> arguments) {
  return report(Diagnostic(kind, span, std::move(arguments)));
}

void Diagnostics::allow(std::vector<Allowance> allowances) {
  allowances_ = std::move(allowances);
  std::stable_sort(allowances_.begin(), allowances_.end(), [](const Allowance& a, const Allowance& b) { return begin_of(a) < begin_of(b); });
  widest_.clear();
  for (size_t i = 0; i < allowances_.size(); ++i) {
    const size_t last = i == 0 ? 0 : widest_.back();
    const bool wider =
        are_of_one_file(allowances_[last], allowances_[i].kind, allowances_[i].scope) && allowances_[i].scope.end <= allowances_[last].scope.end;
    widest_.push_back(wider ? last : i);
  }
  for (Diagnostic& diagnostic : rows_) judge(diagnostic);
}

void Diagnostics::judge_by(WarningPolicy policy) {
  policy_ = std::move(policy);
  for (Diagnostic& diagnostic : rows_) judge(diagnostic);
}

std::vector<Allowance> Diagnostics::useless() const {
  std::vector<std::pair<decltype(begin_of(Allowance())), uint32_t>> warnings;  // and where they end
  for (const Diagnostic& each : rows_) warnings.emplace_back(place(each.kind, each.span), each.span.end);
  std::sort(warnings.begin(), warnings.end());
  std::vector<Allowance> all;
  for (const Allowance& each : allowances_) {
    const auto last = place(each.kind, {each.scope.file, each.scope.end, 0});
    auto at = std::lower_bound(warnings.begin(), warnings.end(), std::pair(begin_of(each), uint32_t{0}));
    while (at != warnings.end() && at->first <= last && at->second > each.scope.end) ++at;  // few reach out of a scope
    if (at == warnings.end() || at->first > last) all.push_back(each);
  }
  return all;
}

bool Diagnostics::has_errors() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Diagnostic& d) { return d.severity() == Severity::error; });
}

std::vector<Diagnostic> first_of(const Diagnostics& diagnostics, size_t most, bool with_allowed) {
  std::vector<Diagnostic> first;
  size_t errors = 0, others = 0;
  for (const Diagnostic& diagnostic : diagnostics.rows())
    if ((with_allowed || !diagnostic.allowed()) && (diagnostic.severity() == Severity::error ? errors : others)++ < most) first.push_back(diagnostic);
  const auto missing = [&](size_t count, const std::string& what) {
    return count <= most ? "" : std::to_string(count - most) + " more " + what + (count - most == 1 ? "" : "s");
  };
  const std::string a = missing(errors, "error"), b = missing(others, "warning");
  const bool one = std::max(errors, most) + std::max(others, most) == 2 * most + 1;
  if (!a.empty() || !b.empty())
    first.emplace_back(DiagnosticKind::NotShown, Span{}, std::vector{a + (!a.empty() && !b.empty() ? " and " : "") + b + (one ? " is" : " are")});
  return first;
}

void Diagnostics::sort() {
  std::stable_sort(rows_.begin(), rows_.end(), [](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  const auto same = [](const Diagnostic& a, const Diagnostic& b) { return key(a) == key(b); };
  rows_.erase(std::unique(rows_.begin(), rows_.end(), same), rows_.end());
}

void Diagnostics::drop_repeats() {
  std::set<std::tuple<DiagnosticKind, uint32_t, uint32_t, uint32_t>> seen;
  std::erase_if(rows_, [&](const Diagnostic& each) {
    return each.span.file.valid() && !seen.emplace(each.kind, each.span.file.value, each.span.begin, each.span.end).second;
  });
}

}  // namespace rg::dsl
