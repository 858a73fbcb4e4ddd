// Golden files of the front end: inputs with their diagnostics written into them, and expected texts beside them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dsl/front_end.h"

namespace rg::dsl::golden {

std::string root();                                          // tests/golden
std::vector<std::string> inputs(const std::string& folder);  // paths of *.rg below tests/golden/<folder>, sorted
std::string read_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);
bool updating();  // RGC_UPDATE=1: rewrite what is expected

// `//~ error[RG0301]: message` speaks of its own line, each `^` after the `~` of one line further up.
struct Expectation {
  std::string file;
  uint32_t line = 0;
  std::string text;  // error[RG0301]: message
  friend auto operator<=>(const Expectation&, const Expectation&) = default;
};
std::vector<Expectation> expectations(const std::string& file, const std::string& text);
std::string without_expectations(const std::string& text);
std::string with_expectations(const std::string& text, const std::vector<Expectation>& expected);

struct Loaded {
  FrontEndResult result;
  Diagnostics diagnostics;
};
// Texts in `replaced` stand in for files.
Loaded load(const std::string& path, const std::map<std::string, std::string>& replaced = {});
// Errors and warnings, and, apart, their notes.
std::vector<Expectation> found(const Loaded& loaded, bool notes);

}  // namespace rg::dsl::golden
