// JSON from outside, and what is wrong with it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace rg::compiler {

// An object, or nothing and `why`.
inline std::optional<nlohmann::json> parse_json_object(std::string_view text, std::string& why) {
  try {
    auto json = nlohmann::json::parse(text);
    if (json.is_object()) return json;
    why = std::string("it holds ") +
          (json.is_array()  ? "a list"
           : json.is_null() ? "null"
                            : std::string("a ") + json.type_name()) +
          ", not an object";
  } catch (const nlohmann::json::out_of_range&) {
    why = "it holds a number that is too large";
  } catch (const nlohmann::json::parse_error& error) {
    why = text.empty() ? "it is empty" : "it is not JSON, from byte " + std::to_string(error.byte) + " on";
  }
  return std::nullopt;
}

}  // namespace rg::compiler
