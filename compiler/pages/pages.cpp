#include "compiler/pages/pages.h"

namespace rg::pages {

std::string fill(std::string_view page, const nlohmann::ordered_json& data) {
  constexpr std::string_view kPlace = "@RGC_PAGE_DATA@";
  const size_t at = page.find(kPlace);
  std::string text(page.substr(0, at));
  for (const char c : data.dump(-1, ' ', true)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text += page.substr(at + kPlace.size());
}

}  // namespace rg::pages
