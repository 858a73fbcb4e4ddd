#include "compiler/spectrum/profile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace rg::compiler {
namespace {

using Json = nlohmann::json;

ProfileResult failed(ProfileFault fault, std::string why) { return {fault, std::move(why), {}}; }

// Reads one document; `why` is empty as long as nothing is wrong.
class Reader {
 public:
  explicit Reader(const dsl::Spectrum& spectrum) : spectrum_(spectrum) {}

  std::optional<Mask> mask(const Json& row) {
    if (!row.is_object() || !row.contains("features") || !row["features"].is_array()) return wrong("a row has no list `features`");
    Mask mask = 0;
    for (const Json& name : row["features"]) {
      if (!name.is_string()) return wrong("a feature is no string");
      const auto bit = bit_of(name.get<std::string>());
      if (!bit) return foreign("spectrum `" + spectrum_.name + "` has no feature `" + name.get<std::string>() + "`");
      mask |= Mask{1} << *bit;
    }
    return mask;
  }

  std::optional<double> number(const Json& row, const char* key) {
    if (!row.contains(key)) return wrong(std::string("a row has no `") + key + "`"), std::nullopt;
    if (!row[key].is_number() || !std::isfinite(row[key].get<double>()) || row[key].get<double>() < 0)
      return wrong(std::string("`") + key + "` is no number, or negative"), std::nullopt;
    return row[key].get<double>();
  }

  bool scene(const Json& row) {
    if (!row.is_object() || !row.contains("masks") || !row["masks"].is_array()) return wrong("a scene has no list `masks`"), false;
    std::map<Mask, double> counts;
    double total = 0;
    for (const Json& each : row["masks"]) {
      const auto set = mask(each);
      const auto tiles = set ? number(each, "tiles") : std::nullopt;
      if (!tiles) return false;
      counts[*set] += *tiles;
      total += *tiles;
    }
    const auto weight = row.contains("weight") ? number(row, "weight") : std::optional(1.0);
    if (!weight) return false;
    for (const auto& [set, tiles] : counts)
      if (total > 0) merged[set] += *weight * tiles / total;
    profile.tiles += total;
    profile.scenes.push_back(row.contains("name") && row["name"].is_string() ? row["name"].get<std::string>() : "unnamed");
    return true;
  }

  bool cost(const Json& row) {
    const auto set = mask(row);
    const auto ms = set ? number(row, "ms") : std::nullopt;
    if (!ms) return false;
    profile.costs.emplace_back(*set, *ms);
    return true;
  }

  std::nullopt_t wrong(std::string text) {
    why = std::move(text);
    return std::nullopt;
  }
  std::nullopt_t foreign(std::string text) {
    fault = ProfileFault::foreign;
    return wrong(std::move(text));
  }

  ProfileFault fault = ProfileFault::unreadable;
  std::string why;
  SpectrumProfile profile;
  std::map<Mask, double> merged;

 private:
  std::optional<uint32_t> bit_of(const std::string& name) const {
    for (uint32_t i = 0; i < spectrum_.members.size(); ++i)
      if (spectrum_.members[i].name == name) return i;
    return std::nullopt;
  }
  const dsl::Spectrum& spectrum_;
};

void normalise(const std::map<Mask, double>& merged, SpectrumProfile& profile) {
  double total = 0;
  for (const auto& [mask, weight] : merged) total += weight;
  for (const auto& [mask, weight] : merged)
    if (weight > 0) profile.histogram.push_back({mask, weight / total});
}

}  // namespace

ProfileResult read_profile(const dsl::Spectrum& spectrum, const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return failed(ProfileFault::unreadable, "it is no JSON");
  if (!json.is_object() || json.value("schema", Json()) != Json("rgc-spectrum-1"))
    return failed(ProfileFault::unreadable, "its `schema` is not `rgc-spectrum-1`");
  if (json.contains("spectrum") && json["spectrum"] != Json(spectrum.name))
    return failed(ProfileFault::foreign,
                  "it was recorded for spectrum `" + (json["spectrum"].is_string() ? json["spectrum"].get<std::string>() : "?") + "`");
  if (!json.contains("scenes") || !json["scenes"].is_array()) return failed(ProfileFault::unreadable, "it has no list `scenes`");
  Reader reader(spectrum);
  for (const Json& scene : json["scenes"])
    if (!reader.scene(scene)) return failed(reader.fault, reader.why);
  if (json.contains("costs") && !json["costs"].is_array()) return failed(ProfileFault::unreadable, "its `costs` are no list");
  for (const Json& row : json.value("costs", Json::array()))
    if (!reader.cost(row)) return failed(reader.fault, reader.why);
  std::sort(reader.profile.costs.begin(), reader.profile.costs.end());
  normalise(reader.merged, reader.profile);
  if (reader.profile.histogram.empty()) return failed(ProfileFault::empty, "");
  return {ProfileFault::none, "", std::move(reader.profile)};
}

SpectrumProfile assumed_profile(const dsl::Spectrum& spectrum) {
  constexpr uint32_t kAllCombinations = 12;
  constexpr double kShare = 0.25;
  const auto count = static_cast<uint32_t>(spectrum.members.size());
  SpectrumProfile profile;
  std::map<Mask, double> merged;
  const auto add = [&](Mask mask) {
    const int on = std::popcount(mask);
    merged[mask] = std::pow(kShare, on) * std::pow(1 - kShare, static_cast<double>(count) - on);
  };
  if (count <= kAllCombinations) {
    for (Mask mask = 0; mask < Mask{1} << count; ++mask) add(mask);
  } else {
    add(0);
    for (uint32_t a = 0; a < count; ++a)
      for (uint32_t b = a; b < count; ++b)
        for (uint32_t c = b; c < count; ++c) add(Mask{1} << a | Mask{1} << b | Mask{1} << c);
  }
  normalise(merged, profile);
  return profile;
}

}  // namespace rg::compiler
