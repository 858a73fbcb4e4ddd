#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "compiler/parse_json.h"
#include "compiler/profiles.h"

namespace rg::compiler {
namespace {

using Json = nlohmann::json;
using dsl::DiagnosticKind;

struct Promise {
  std::set<std::string> features;
  std::map<std::string, double> limits;
};

// Sample counts and the like are lists of bits: the highest counts.
double number_of(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  double most = 0;
  if (!value.is_array()) return most;
  for (const Json& each : value) {
    const std::string text = each.is_string() ? each.get<std::string>() : "";
    const size_t digits = text.find_first_of("0123456789");
    if (text.starts_with("VK_SAMPLE_COUNT_") && digits != std::string::npos) most = std::max(most, std::strtod(text.c_str() + digits, nullptr));
    if (each.is_number()) most = most == 0 ? each.get<double>() : std::min(most, each.get<double>());
  }
  return most;
}

void take_limits(const Json& properties, Promise& promise) {
  for (const auto& [key, value] : properties.items()) {
    if (value.is_object())
      take_limits(value, promise);
    else
      promise.limits[key] = number_of(value);
  }
}

// One object of `capabilities`.
Promise read_capability(const Json& capability) {
  Promise promise;
  const auto features = capability.find("features");
  if (features != capability.end() && features->is_object())
    for (const auto& [structure, members] : features->items()) {
      if (!members.is_object()) continue;
      for (const auto& [feature, on] : members.items())
        if (on.is_boolean() && on.get<bool>()) promise.features.insert(feature);
    }
  const auto properties = capability.find("properties");
  if (properties != capability.end() && properties->is_object()) take_limits(*properties, promise);
  return promise;
}

void add(Promise& all, const Promise& more) {
  all.features.insert(more.features.begin(), more.features.end());
  for (const auto& [name, value] : more.limits) {
    const auto at = all.limits.emplace(name, value).first;
    at->second = std::max(at->second, value);
  }
}

// Of alternatives only what both promise holds.
Promise common(const Promise& a, const Promise& b) {
  Promise both;
  std::set_intersection(a.features.begin(), a.features.end(), b.features.begin(), b.features.end(),
                        std::inserter(both.features, both.features.end()));
  for (const auto& [name, value] : a.limits)
    if (const auto other = b.limits.find(name); other != b.limits.end()) both.limits[name] = std::min(value, other->second);
  return both;
}

struct File {
  const Json& capabilities;
  std::string fault;  // empty: none
};

Promise named_capability(File& file, const Json& name) {
  const auto at = name.is_string() ? file.capabilities.find(name.get<std::string>()) : file.capabilities.end();
  if (at != file.capabilities.end() && at->is_object()) return read_capability(*at);
  file.fault = name.is_string() ? "there are no capabilities called `" + name.get<std::string>() + "`" : "its capabilities are no list of names";
  return {};
}

Promise read_profile(File& file, const Json& profile) {
  Promise all;
  const auto list = profile.find("capabilities");
  if (list == profile.end() || !list->is_array()) return file.fault = "a profile lists no capabilities", all;
  for (const Json& entry : *list) {
    if (!entry.is_array()) {
      add(all, named_capability(file, entry));
      continue;
    }
    std::optional<Promise> shared;
    for (const Json& alternative : entry) {
      const Promise one = named_capability(file, alternative);
      shared = shared ? common(*shared, one) : one;
    }
    if (shared) add(all, *shared);
  }
  return all;
}

uint32_t api_minor(const Json& profile) {
  const auto version = profile.find("api-version");
  if (version == profile.end() || !version->is_string()) return 0;
  const std::string text = version->get<std::string>();
  return text.starts_with("1.") ? static_cast<uint32_t>(std::strtoul(text.c_str() + 2, nullptr, 10)) : 0;
}

dsl::Profile row_of(const std::string& name, const Json& profile, const Promise& promise, dsl::Span span) {
  dsl::Profile row;
  row.name = name;
  row.api_minor = api_minor(profile);
  row.features.assign(promise.features.begin(), promise.features.end());
  for (const auto& [limit, value] : promise.limits) row.limits.push_back({limit, value});
  row.span = span;
  return row;
}

// What is wrong with the file, or nothing and its profiles.
std::string read_file(const std::string& text, dsl::Span span, std::vector<dsl::Profile>& rows) {
  std::string why;
  const auto object = parse_json_object(text, why);
  if (!object) return why;
  const Json& json = *object;
  const auto capabilities = json.find("capabilities"), profiles = json.find("profiles");
  if (capabilities == json.end() || profiles == json.end() || !capabilities->is_object() || !profiles->is_object())
    return "it has no `capabilities` and `profiles`";
  File file{*capabilities, ""};
  for (const auto& [name, profile] : profiles->items()) {
    if (!profile.is_object()) return "profile `" + name + "` is no object";
    rows.push_back(row_of(name, profile, read_profile(file, profile), span));
    if (!file.fault.empty()) return file.fault;
  }
  return rows.empty() ? "it holds no profile" : "";
}

}  // namespace

dsl::Program read_profiles(dsl::Program program, const ReadFile& read, dsl::Diagnostics& diagnostics) {
  std::vector<dsl::Profile> rows;
  for (const dsl::Profile& named : program.profiles) {
    std::string why;
    const auto text = read(named.name, why);
    std::vector<dsl::Profile> found;
    const std::string fault = text ? read_file(*text, named.span, found) : why;
    if (!fault.empty()) diagnostics.report(DiagnosticKind::ProfileNotReadable, named.span, {named.name, fault});
    rows.insert(rows.end(), found.begin(), found.end());
  }
  program.profiles = std::move(rows);
  return program;
}

}  // namespace rg::compiler
