// Any bytes as a root file: diagnostics or a program, never a crash; and what is printed about them lies within the text.
#include "dsl/check_macro.h"
#include "dsl/front_end.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const rg::dsl::ReadSource read = [&](const std::string& path, std::string& why) -> std::optional<std::string> {
    if (path == "fuzz.rg") return text;
    why = "no such file";
    return std::nullopt;
  };
  rg::dsl::Diagnostics diagnostics;
  const rg::dsl::FrontEndResult result = rg::dsl::load_program("fuzz.rg", read, diagnostics);
  for (const rg::dsl::Diagnostic& row : diagnostics.rows())
    RG_CHECK(!row.span.file.valid() || (row.span.begin <= row.span.end && row.span.end <= text.size()), "spans lie within the text");
  diagnostics.sort();
  rg::dsl::print(diagnostics, result.files, false);
  rg::dsl::print_json(diagnostics, result.files);
  return 0;
}
