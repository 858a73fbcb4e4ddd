// Did you mean?
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dsl/diagnostics.h"

namespace rg::dsl {

struct Guess {
  std::vector<std::string> words;  // equally near; none: nothing is near enough to be meant
  bool certain = false;            // one word, and nothing else can be meant

  std::string shown() const;  // "a` or `b"
};

// The candidates nearest to `word`: insertions, deletions, substitutions and swaps of neighbours count one each, and up to a third of the word may
// differ.
Guess closest(std::string_view word, const std::vector<std::string_view>& candidates);
// Of types and formats, where a letter or a digit more is another meaning: only the order and the case of the same characters is a slip.
Guess closest_type(std::string_view word, const std::vector<std::string_view>& candidates);
// A fix where the guess is certain, a note where it is not.
void suggest(Diagnostic& diagnostic, Span span, const Guess& guess);

}  // namespace rg::dsl
