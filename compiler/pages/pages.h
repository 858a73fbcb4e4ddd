// HTML pages that commands fill with their data: one file each in this folder, self-contained, embedded when rgc is built.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace rg::pages {

// The page with `data` where it says @RGC_PAGE_DATA@, escaped so that no text in it can end the script element.
std::string fill(std::string_view page, const nlohmann::ordered_json& data);

std::string_view graph();  // graph.html: an array of rgc-plan-1 objects with `decisions` and `figures`

}  // namespace rg::pages
