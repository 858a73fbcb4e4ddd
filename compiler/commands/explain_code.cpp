#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/explain.h"
#include "compiler/commands/pages.h"

namespace rg::commands {
namespace {

using dsl::DiagnosticKind;

constexpr const char* kSeverities[] = {"error", "warning", "note"};

std::string code_line(DiagnosticKind kind) {
  const dsl::DiagnosticRow& info = dsl::row(kind);
  return fmt::format("{} {} {}: {}\n", info.code, kSeverities[static_cast<size_t>(info.severity)], info.name, info.message);
}

std::string indented(const std::string& text) {
  std::string out;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    out += (end > begin ? "  " : "") + text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return out;
}

std::string page_text(const Page& page) {
  if (!page.of.empty()) return fmt::format("{}\nA note of {}: see `rgc explain {}`.\n", page.why, page.of, page.of);
  return fmt::format("{}\nwrong\n\n{}\nright\n\n{}", page.why, indented(page.wrong), indented(page.right));
}

}  // namespace

std::string code_of(const std::string& text) {
  std::string upper = text;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const bool digits =
      upper.size() == 6 && upper.starts_with("RG") && std::all_of(upper.begin() + 2, upper.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits) return upper;
  for (const DiagnosticKind kind : dsl::all_diagnostic_kinds())
    if (dsl::row(kind).name == text) return std::string(dsl::row(kind).code);
  return {};
}

int explain_code(const std::string& code) {
  for (const DiagnosticKind kind : dsl::all_diagnostic_kinds()) {
    if (dsl::row(kind).code != code) continue;
    const Page* page = find_page(code);
    print(code_line(kind) + "\n" + (page ? page_text(*page) : std::string()));
    return exit_done;
  }
  dsl::Diagnostics diagnostics;
  diagnostics.report(DiagnosticKind::UnknownCode, {}, {code});
  return finish(diagnostics, {});
}

int list_codes() {
  std::vector<std::string> lines;
  for (const DiagnosticKind kind : dsl::all_diagnostic_kinds()) lines.push_back(code_line(kind));
  std::sort(lines.begin(), lines.end());
  for (const std::string& line : lines) print(line);
  return exit_done;
}

}  // namespace rg::commands
