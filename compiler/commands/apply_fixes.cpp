#include "compiler/commands/apply_fixes.h"

#include <algorithm>

namespace rg::commands {
namespace {

void collect(const dsl::Diagnostic& diagnostic, dsl::FileId file, std::vector<dsl::FixIt>& fixes) {
  for (const dsl::FixIt& fix : diagnostic.fixes)
    if (fix.span.file == file) fixes.push_back(fix);
  for (const dsl::Diagnostic& note : diagnostic.notes) collect(note, file, fixes);
}

}  // namespace

Fixed apply_fixes(const dsl::Diagnostics& diagnostics, const dsl::SourceFiles& files, dsl::FileId file) {
  std::vector<dsl::FixIt> fixes;
  for (const dsl::Diagnostic& diagnostic : diagnostics.rows())
    if (!diagnostic.allowed()) collect(diagnostic, file, fixes);
  std::stable_sort(fixes.begin(), fixes.end(), [](const dsl::FixIt& a, const dsl::FixIt& b) { return a.span.begin < b.span.begin; });
  const std::string& text = files[file].text;
  Fixed fixed;
  uint32_t at = 0;
  bool first = true;
  for (const dsl::FixIt& fix : fixes) {
    if ((!first && fix.span.begin <= at && fix.span.begin < fix.span.end) || fix.span.begin < at || fix.span.end > text.size()) continue;
    if (text.compare(fix.span.begin, fix.span.end - fix.span.begin, fix.text) == 0) continue;  // nothing would come of it, again and again
    fixed.text += text.substr(at, fix.span.begin - at) + fix.text;
    at = fix.span.end;
    first = false;
    ++fixed.count;
  }
  fixed.text += text.substr(at);
  return fixed;
}

}  // namespace rg::commands
