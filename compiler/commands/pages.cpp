#include "compiler/commands/pages.h"

#include <algorithm>
#include <sstream>

#include "dsl/check_macro.h"

namespace rg::commands {

extern const char* const kPageTexts[];  // ends with a null pointer

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

PageContext context_of(const std::string& word) {
  if (word == "file") return PageContext::file;
  RG_CHECK(word == "graph" || word == "text", "a page says where its examples stand");
  return word == "graph" ? PageContext::graph : PageContext::text;
}

// `== RG0301 graph`, `== RG0302 of RG0301`
Page heading(const std::string& line) {
  std::istringstream words(line.substr(2));
  Page page;
  std::string word;
  words >> page.code >> word;
  if (word == "of")
    words >> page.of;
  else
    page.context = context_of(word);
  return page;
}

void read_text(const std::string& text, std::vector<Page>& all) {
  std::string* part = nullptr;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("== ")) {
      all.push_back(heading(line));
      part = &all.back().why;
    } else if (line == "-- wrong" || line == "-- right") {
      part = line == "-- wrong" ? &all.back().wrong : &all.back().right;
    } else if (part) {
      *part += line + "\n";
    }
  }
}

std::vector<Page> read_pages() {
  std::vector<Page> all;
  for (const char* const* text = kPageTexts; *text; ++text) read_text(*text, all);
  std::sort(all.begin(), all.end(), [](const Page& a, const Page& b) { return a.code < b.code; });
  return all;
}

// What stands around the items of a graph.
constexpr const char* kFrameBegin =
    "module example\n"
    "extent view = runtime(64, 64) max(128, 128)\n"
    "struct Light { at: vec3  range: f32 }\n"
    "sampler linear { filter linear }\n"
    "graph frame(surface backbuffer: rgba8 view after copy_src)\n{\n";

}  // namespace

const std::vector<Page>& pages() {
  static const std::vector<Page> all = read_pages();
  return all;
}

const Page* find_page(std::string_view code) {
  const auto at =
      std::lower_bound(pages().begin(), pages().end(), code, [](const Page& page, std::string_view wanted) { return page.code < wanted; });
  return at != pages().end() && at->code == code ? &*at : nullptr;
}

std::vector<ExampleFile> example_files(PageContext context, const std::string& example) {
  std::vector<ExampleFile> files = {{"example.rg", ""}};
  for (const std::string& line : lines_of(example)) {
    if (line.starts_with("--- "))
      files.push_back({line.substr(4), ""});
    else
      files.back().text += line + "\n";
  }
  if (context == PageContext::graph) files[0].text = kFrameBegin + files[0].text + "}\n";
  return files;
}

}  // namespace rg::commands
