// Which runs of the front end and which specialisations the shaders of a pass take.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compiler/shaders/interface.h"
#include "compiler/shaders/shaders.h"
#include "compiler/shaders/sources.h"

namespace rg::compiler {

// A file and everything it may include, in order of first mention: `#include "..."` lines are followed whatever `#if` they stand in. `text` is null
// where nothing readable was found.
struct SourceText {
  std::string path;
  const std::string* text = nullptr;
};
std::vector<SourceText> include_closure(const std::string& path, const std::string& text, ShaderSources& sources);

// By Pass::features: whether any of the texts names its macro.
std::vector<bool> features_of_preprocessor(const dsl::Pass& pass, const std::vector<SourceText>& texts);

// The values that the preprocessor has to know; the rest is left to specialisation.
FixedFeatures preprocessor_key(const std::vector<uint32_t>& values, const std::vector<bool>& fixed);

// "fog=on, path=low": those features that are fixed.
std::string key_text(const dsl::Pass& pass, const FixedFeatures& key);

// Of keys of one shader, some of which fail: the fewest values that only failing keys have, or none where no such set exists.
std::optional<FixedFeatures> smallest_failing_key(const std::vector<FixedFeatures>& keys, const std::vector<bool>& fails);

// Combinations of the values of the features a pass names; saturates.
uint64_t combinations(const dsl::Program& program, const dsl::Pass& pass);

}  // namespace rg::compiler
