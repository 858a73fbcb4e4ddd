// Diagnostics as text for a person and as JSON for a program.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "dsl/diagnostics.h"
#include "dsl/visible.h"

namespace rg::dsl {
namespace {

constexpr const char* kSeverityNames[] = {"error", "warning", "note"};
constexpr const char* kSeverityColours[] = {"\033[1;31m", "\033[1;35m", "\033[1;36m"};
constexpr size_t kMaxSnippet = 160;  // columns of a source line that are shown

struct Printer {
  const SourceFiles& files;
  bool colour;
  std::string out;

  std::string paint(const char* code, const std::string& text) const { return colour ? code + text + "\033[0m" : text; }
};

const SourceFile* file_of(const SourceFiles& files, Span span) {
  return span.file.valid() && span.file.value < files.size() ? &files[span.file] : nullptr;
}

// Tabs are kept in the marker line, so that it lines up whatever their width.
std::string padding(std::string_view line, size_t bytes) {
  const std::string_view before = line.substr(0, bytes);
  std::string pad;
  for (size_t at = 0; at < before.size();) {
    const size_t tab = std::min(before.find('\t', at), before.size());
    pad += std::string(code_points(before.substr(at, tab - at)), ' ') + (tab < before.size() ? "\t" : "");
    at = tab + 1;
  }
  return pad + std::string(bytes - before.size(), ' ');
}

// Where the character begins that has a byte at `at`.
size_t character_at(std::string_view line, size_t at) {
  for (size_t back = 0; back < 3 && at > back; ++back)
    if (at - back < line.size() && (static_cast<unsigned char>(line[at - back]) & 0xc0) != 0x80) return at - back;
  return at;
}

void print_snippet(Printer& printer, const SourceFile& file, Span span) {
  const Position at = file.position(span.begin);
  std::string_view line = file.line(at.line);
  size_t column = at.column - 1;
  const size_t from = column > kMaxSnippet / 2 && line.size() > kMaxSnippet ? character_at(line, column - kMaxSnippet / 2) : 0;
  const size_t end = from + kMaxSnippet < line.size() ? character_at(line, from + kMaxSnippet) : line.size();
  line = line.substr(std::min(from, line.size()), end - std::min(from, end));
  column -= from;
  const size_t bytes = std::min<size_t>(span.end - span.begin, line.size() > column ? line.size() - column : 1);
  const size_t width = std::max<size_t>(1, column < line.size() ? code_points(line.substr(column, bytes)) : bytes);
  printer.out += fmt::format("{:>6} | {}\n", at.line, visible(line));
  printer.out += fmt::format("       | {}{}\n", padding(line, column), printer.paint("\033[1;32m", "^" + std::string(width - 1, '~')));
}

void print_fix(Printer& printer, const FixIt& fix) {
  const SourceFile* file = file_of(printer.files, fix.span);
  if (!file) return;
  const std::string old = visible(file->text.substr(fix.span.begin, fix.span.end - fix.span.begin), LineBreaks::kept);
  const std::string text = visible(fix.text, LineBreaks::kept);
  const size_t shown = text.find_first_not_of("\n \t");
  const bool line = text.starts_with("\n") && shown != std::string::npos;
  if (old.empty()) printer.out += fmt::format("       = fix: insert {}`{}`\n", line ? "a line " : "", line ? text.substr(shown) : text);
  if (!old.empty() && text.empty()) printer.out += fmt::format("       = fix: remove `{}`\n", old);
  if (!old.empty() && !text.empty()) printer.out += fmt::format("       = fix: write `{}` instead of `{}`\n", text, old);
}

void print_one(Printer& printer, const Diagnostic& diagnostic) {
  const DiagnosticRow& info = row(diagnostic.kind);
  const auto severity = static_cast<size_t>(diagnostic.severity());
  const SourceFile* file = file_of(printer.files, diagnostic.span);
  if (file) {
    const Position at = file->position(diagnostic.span.begin);
    printer.out += fmt::format("{}:{}:{}: ", visible(file->path), at.line, at.column);
  }
  const std::string head = fmt::format("{}[{}]:", kSeverityNames[severity], info.code);
  printer.out += printer.paint(kSeverityColours[severity], head) + " " + visible(diagnostic.message()) + "\n";
  if (file) print_snippet(printer, *file, diagnostic.span);
  for (const FixIt& fix : diagnostic.fixes) print_fix(printer, fix);
  for (const Diagnostic& child : diagnostic.notes) print_one(printer, child);
}

nlohmann::ordered_json place(const SourceFiles& files, Span span) {
  const SourceFile* file = file_of(files, span);
  if (!file) return {{"file", nullptr}, {"line", 0}, {"column", 0}, {"end_line", 0}, {"end_column", 0}};
  const Position begin = file->position(span.begin), end = file->position(span.end);
  return {{"file", file->path}, {"line", begin.line}, {"column", begin.column}, {"end_line", end.line}, {"end_column", end.column}};
}

nlohmann::ordered_json to_json(const SourceFiles& files, const Diagnostic& diagnostic) {
  const DiagnosticRow& info = row(diagnostic.kind);
  nlohmann::ordered_json json = {{"code", info.code},
                                 {"name", info.name},
                                 {"severity", kSeverityNames[static_cast<size_t>(diagnostic.severity())]},
                                 {"message", diagnostic.message()}};
  json.update(place(files, diagnostic.span));
  json["notes"] = nlohmann::ordered_json::array();
  for (const Diagnostic& child : diagnostic.notes) json["notes"].push_back(to_json(files, child));
  json["fixes"] = nlohmann::ordered_json::array();
  for (const FixIt& fix : diagnostic.fixes) {
    nlohmann::ordered_json entry = place(files, fix.span);
    entry["text"] = fix.text;
    json["fixes"].push_back(entry);
  }
  if (!diagnostic.allowed()) return json;
  nlohmann::ordered_json suppression = {{"kind", diagnostic.standing == Standing::allowed_here ? "inSource" : "external"}};
  if (diagnostic.standing == Standing::allowed_here) suppression.update(place(files, diagnostic.allowed_at));
  json["suppressions"] = nlohmann::ordered_json::array({suppression});
  return json;
}

}  // namespace

std::string print(const Diagnostics& diagnostics, const SourceFiles& files, bool colour) {
  Printer printer{files, colour, {}};
  for (const Diagnostic& diagnostic : first_of(diagnostics, kMostForPeople, false)) print_one(printer, diagnostic);
  return printer.out;
}

std::string print_json(const Diagnostics& diagnostics, const SourceFiles& files) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Diagnostic& diagnostic : first_of(diagnostics, kMostForPrograms, true)) json.push_back(to_json(files, diagnostic));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace rg::dsl
