#include "compiler/shaders/variants.h"

#include <algorithm>
#include <bit>
#include <sstream>

#include "compiler/shaders/glsl_words.h"

namespace rg::compiler {
namespace {

bool names(const std::string& text, const std::string& word) {
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]))) return true;
  }
  return false;
}

// The path of `  #  include "path"`.
std::optional<std::string> included_path(const std::string& line) {
  size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return std::nullopt;
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return std::nullopt;
  const size_t begin = line.find_first_of("\"<", at), end = line.find_first_of("\">", begin + 1);
  if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
  return line.substr(begin + 1, end - begin - 1);
}

SourceText find_include(const std::string& from, const std::string& header, ShaderSources& sources) {
  for (const std::string& folder : {folder_of(from), std::string()}) {
    const auto path = resolve_path(folder, header);
    const std::string* text = path ? sources.find(*path) : nullptr;
    if (text != nullptr) return {*path, text};
  }
  return {from + " -> " + header, nullptr};
}

std::string value_text(const dsl::ShaderFeature& feature, uint32_t value) {
  if (feature.values.empty()) return value != 0 ? "on" : "off";
  return value < feature.values.size() ? feature.values[value] : std::to_string(value);
}

bool agrees(const FixedFeatures& key, const FixedFeatures& part) {
  for (size_t i = 0; i < part.size(); ++i)
    if (part[i] && key[i] != part[i]) return false;
  return true;
}

bool only_failing_have(const FixedFeatures& part, const std::vector<FixedFeatures>& keys, const std::vector<bool>& fails) {
  for (size_t k = 0; k < keys.size(); ++k)
    if (!fails[k] && agrees(keys[k], part)) return false;
  return true;
}

}  // namespace

std::vector<SourceText> include_closure(const std::string& path, const std::string& text, ShaderSources& sources) {
  std::vector<SourceText> closure = {{path, &text}};
  for (size_t i = 0; i < closure.size(); ++i) {
    if (closure[i].text == nullptr) continue;
    std::istringstream lines(*closure[i].text);
    for (std::string line; std::getline(lines, line);) {
      const auto header = included_path(line);
      if (!header) continue;
      SourceText found = find_include(closure[i].path, *header, sources);
      const auto same = [&](const SourceText& other) { return other.path == found.path; };
      if (std::none_of(closure.begin(), closure.end(), same)) closure.push_back(std::move(found));
    }
  }
  return closure;
}

std::vector<bool> features_of_preprocessor(const dsl::Pass& pass, const std::vector<SourceText>& texts) {
  std::vector<bool> fixed;
  for (const dsl::ShaderFeature& feature : pass.features)
    fixed.push_back(std::any_of(texts.begin(), texts.end(),
                                [&](const SourceText& source) { return source.text != nullptr && names(*source.text, feature_macro(feature)); }));
  return fixed;
}

FixedFeatures preprocessor_key(const std::vector<uint32_t>& values, const std::vector<bool>& fixed) {
  FixedFeatures key(values.size());
  for (size_t i = 0; i < values.size(); ++i)
    if (fixed[i]) key[i] = values[i];
  return key;
}

std::string key_text(const dsl::Pass& pass, const FixedFeatures& key) {
  std::string text;
  for (size_t i = 0; i < key.size(); ++i)
    if (key[i]) text += (text.empty() ? "" : ", ") + pass.features[i].name + "=" + value_text(pass.features[i], *key[i]);
  return text;
}

std::optional<FixedFeatures> smallest_failing_key(const std::vector<FixedFeatures>& keys, const std::vector<bool>& fails) {
  constexpr size_t kMostFeatures = 16;  // beyond it a whole failing key is named
  std::optional<FixedFeatures> best;
  size_t best_size = SIZE_MAX;
  for (size_t k = 0; k < keys.size(); ++k) {
    if (!fails[k]) continue;
    std::vector<size_t> fixed;
    for (size_t i = 0; i < keys[k].size(); ++i)
      if (keys[k][i]) fixed.push_back(i);
    const size_t subsets = fixed.size() <= kMostFeatures ? size_t{1} << fixed.size() : 1;
    for (size_t subset = 0; subset < subsets; ++subset) {
      const size_t size = fixed.size() <= kMostFeatures ? static_cast<size_t>(std::popcount(subset)) : fixed.size();
      if (size >= best_size) continue;
      FixedFeatures part(keys[k].size());
      for (size_t i = 0; i < fixed.size(); ++i)
        if (fixed.size() > kMostFeatures || (subset >> i & 1)) part[fixed[i]] = keys[k][fixed[i]];
      if (!only_failing_have(part, keys, fails)) continue;
      best = std::move(part);
      best_size = size;
    }
  }
  return best;
}

uint64_t combinations(const dsl::Program& program, const dsl::Pass& pass) {
  uint64_t product = 1;
  for (const dsl::ShaderFeature& feature : pass.features) {
    const uint64_t values = feature.feature.valid() ? program.features[feature.feature].values.size() : 1;
    product = product > UINT64_MAX / std::max<uint64_t>(values, 1) ? UINT64_MAX : product * values;
  }
  return product;
}

}  // namespace rg::compiler
