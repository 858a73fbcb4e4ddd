// How many words a text becomes once its macros are expanded: bounded without expanding, since twenty lines of `#define` can mean a billion words.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "compiler/shaders/glsl_words.h"

namespace rg::compiler {

constexpr uint64_t kMostWords = uint64_t{1} << 20;  // of one shader; one that a person writes has some thousands

// An upper bound: branches of `#if` count as if all were taken, a name means the longest of its definitions wherever they stand.
//
//   #define TWO(x) x x            TWO(TWO(a)) is 4 words: what an argument becomes is measured first, then the body with
//   #define FOUR  TWO(1) TWO(2)   arguments of that length. Equal calls are measured once, so that a chain of n macros takes n steps.
//
// A macro within itself is a plain word, as in the preprocessor. Effort is counted in words looked at; beyond kMostSteps a text counts as too long.
class Expansions {
 public:
  // Words of texts that outlive this object; `#define` lines count whatever the text they stand in.
  void add_macros(const std::vector<GlslWord>& words);

  struct Measure {
    uint64_t words = 0;                 // kMostWords + 1 is any number beyond
    const GlslWord* longest = nullptr;  // the word of the text that becomes longest; null in an empty text
  };
  Measure measure(const std::vector<GlslWord>& text);

 private:
  struct Macro {
    bool has_parameters = false;
    std::vector<std::string_view> parameters;
    std::vector<std::string_view> body;
  };
  // What stands for a parameter: its length once expanded, and its ends as written, which `##` joins.
  struct Argument {
    uint64_t words = 0;
    std::string_view first, last;
    auto operator<=>(const Argument&) const = default;
  };
  using Arguments = std::vector<Argument>;
  using Words = std::vector<std::string_view>;
  struct Scope {
    const std::vector<std::string_view>* parameters = nullptr;
    const Arguments* arguments = nullptr;
  };
  static constexpr uint64_t kMostSteps = uint64_t{1} << 22;
  static constexpr size_t kMostDepth = 128;

  void add_macro(const std::vector<GlslWord>& words, size_t name, size_t end);
  uint64_t words_of(const Words& words, const Scope& scope);
  uint64_t words_at(const Words& words, size_t& at, const Scope& scope);
  std::string_view joined(const Words& words, size_t& at, const Scope& scope);
  uint64_t words_of_macro(std::string_view name, const Words& words, size_t& at, const Scope& scope);
  uint64_t words_of_call(const Macro& macro, const Arguments& arguments);
  std::optional<Arguments> arguments_at(const Words& words, size_t& at, const Scope& scope);
  bool takes_arguments(std::string_view name) const;
  static const Argument* argument_of(std::string_view word, const Scope& scope);

  std::map<std::string_view, std::vector<Macro>> macros_;
  std::map<std::pair<const Macro*, Arguments>, uint64_t> measured_;
  std::set<std::string> joined_;  // names that `##` makes
  std::set<std::string_view> open_;
  bool cut_ = false;  // a macro within itself was met: the length holds only here
  uint64_t steps_ = 0;
  size_t depth_ = 0;
};

}  // namespace rg::compiler
