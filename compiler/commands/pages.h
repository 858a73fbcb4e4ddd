// What `rgc explain CODE` shows beside the message: why, an example that is wrong, one that is right. The texts are pages/*.txt.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rg::commands {

// Where an example stands: a whole file, items of a graph (see in_frame), or text that is only shown.
enum class PageContext : uint8_t { file, graph, text };
struct Page {
  std::string code;
  std::string of;  // of a note: the error it belongs to, whose examples hold; else empty
  PageContext context = PageContext::text;
  std::string why, wrong, right;  // further files of an example follow behind lines `--- NAME`
};
// In order of their codes.
const std::vector<Page>& pages();
const Page* find_page(std::string_view code);

// The files of an example: the root file first, as "example.rg".
struct ExampleFile {
  std::string name, text;
};
std::vector<ExampleFile> example_files(PageContext context, const std::string& example);

}  // namespace rg::commands
