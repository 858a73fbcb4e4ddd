#include "compiler/shaders/expansion.h"

#include <algorithm>

namespace rg::compiler {
namespace {

uint64_t sum(uint64_t a, uint64_t b) { return std::min(a + b, kMostWords + 1); }

bool begins_directive(const std::vector<GlslWord>& words, size_t i) {
  const bool first = i == 0 || words[i - 1].line < words[i].line || words[i - 1].file != words[i].file || !words[i - 1].directive;
  const bool joins = i + 1 < words.size() && words[i + 1].text == "#";
  return words[i].directive && words[i].text == "#" && first && !joins;
}

size_t end_of_directive(const std::vector<GlslWord>& words, size_t begin) {
  size_t end = begin + 1;
  while (end < words.size() && words[end].directive && !begins_directive(words, end)) ++end;
  return end;
}

}  // namespace

void Expansions::add_macros(const std::vector<GlslWord>& words) {
  for (size_t i = 0; i < words.size(); ++i) {
    if (!begins_directive(words, i)) continue;
    const size_t end = end_of_directive(words, i);
    if (i + 2 < end && words[i + 1].text == "define") add_macro(words, i + 2, end);
    i = end - 1;
  }
}

void Expansions::add_macro(const std::vector<GlslWord>& words, size_t name, size_t end) {
  Macro macro;
  size_t at = name + 1;
  macro.has_parameters = at < end && words[at].text == "(" && words[at].at == words[name].at + words[name].text.size();
  if (macro.has_parameters)
    for (++at; at < end && words[at++].text != ")";)
      if (words[at - 1].is_name()) macro.parameters.push_back(words[at - 1].text);
  for (; at < end; ++at)
    if (words[at].text != "\\") macro.body.push_back(words[at].text);
  macros_[words[name].text].push_back(std::move(macro));
}

Expansions::Measure Expansions::measure(const std::vector<GlslWord>& text) {
  Words words;
  std::vector<const GlslWord*> places;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool directive = begins_directive(text, i);
    const size_t end = directive ? end_of_directive(text, i) : i + 1;
    const bool condition = directive && i + 1 < end && (text[i + 1].text == "if" || text[i + 1].text == "elif");
    for (size_t k = condition ? i + 2 : i; k < end; ++k)
      if (!directive || condition) words.push_back(text[k].text), places.push_back(&text[k]);
    i = end - 1;
  }
  Measure result;
  uint64_t most = 0;
  for (size_t at = 0; at < words.size() && result.words <= kMostWords;) {
    const GlslWord* place = places[at];
    const uint64_t count = words_at(words, at, {});
    result.words = sum(result.words, count);
    if (count > most) most = count, result.longest = place;
  }
  return result;
}

uint64_t Expansions::words_of(const Words& words, const Scope& scope) {
  if (depth_ >= kMostDepth) return kMostWords + 1;
  ++depth_;
  uint64_t count = 0;
  for (size_t at = 0; at < words.size() && count <= kMostWords;) count = sum(count, words_at(words, at, scope));
  --depth_;
  return count;
}

// The length of what begins at `at`, which moves past it.
uint64_t Expansions::words_at(const Words& words, size_t& at, const Scope& scope) {
  if (++steps_ > kMostSteps) return at = words.size(), kMostWords + 1;
  const bool joins = at + 3 < words.size() && words[at + 1] == "#" && words[at + 2] == "#";
  const Argument* argument = joins ? nullptr : argument_of(words[at], scope);
  const bool named = argument != nullptr && argument->words == 1 && takes_arguments(argument->first);  // it may be called here
  if (argument != nullptr && !named) return ++at, argument->words;
  const std::string_view name = joins ? joined(words, at, scope) : argument != nullptr ? argument->first : words[at];
  ++at;
  return words_of_macro(name, words, at, scope);
}

// `a ## b ## c` is one word; `at` moves to its last part.
std::string_view Expansions::joined(const Words& words, size_t& at, const Scope& scope) {
  const Argument* first = argument_of(words[at], scope);
  std::string name(first != nullptr ? first->last : words[at]);
  while (at + 3 < words.size() && words[at + 1] == "#" && words[at + 2] == "#") {
    at += 3;
    const Argument* next = argument_of(words[at], scope);
    name += next != nullptr ? next->first : words[at];
  }
  return *joined_.insert(std::move(name)).first;
}

// `at` is behind the name. What a body ends with may take the arguments that follow the call: `#define F 1 + G` and `F(x)`.
uint64_t Expansions::words_of_macro(std::string_view name, const Words& words, size_t& at, const Scope& scope) {
  const auto found = macros_.find(name);
  if (found == macros_.end()) return 1;
  if (open_.contains(name)) return cut_ = true, 1;
  std::optional<Arguments> arguments;
  if (takes_arguments(name)) arguments = arguments_at(words, at, scope);
  open_.insert(name);
  uint64_t most = 1;
  for (const Macro& macro : found->second) {
    if (macro.has_parameters && !arguments) continue;
    most = std::max(most, words_of_call(macro, macro.has_parameters ? *arguments : Arguments{}));
  }
  std::string_view last;
  for (const Macro& macro : found->second)
    if (!macro.body.empty() && macro.body.back() != name && takes_arguments(macro.body.back())) last = macro.body.back();
  if (!last.empty() && at < words.size() && words[at] == "(") most = sum(most, words_of_macro(last, words, at, scope));
  open_.erase(name);
  return most;
}

uint64_t Expansions::words_of_call(const Macro& macro, const Arguments& arguments) {
  const auto known = measured_.find({&macro, arguments});
  if (known != measured_.end()) return known->second;
  const bool cut_before = std::exchange(cut_, false);
  const uint64_t count = words_of(macro.body, {&macro.parameters, &arguments});
  if (!cut_) measured_.emplace(std::pair(&macro, arguments), count);
  cut_ |= cut_before;
  return count;
}

// None where no `(` follows, or its `)` does not.
std::optional<Expansions::Arguments> Expansions::arguments_at(const Words& words, size_t& at, const Scope& scope) {
  if (at >= words.size() || words[at] != "(") return std::nullopt;
  Arguments arguments;
  Words argument;
  int depth = 1;
  for (size_t i = at + 1; i < words.size(); ++i) {
    ++steps_;
    depth += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
    if (depth > 0 && !(depth == 1 && words[i] == ",")) {
      argument.push_back(words[i]);
      continue;
    }
    const Argument* first = argument.empty() ? nullptr : argument_of(argument.front(), scope);
    const Argument* last = argument.empty() ? nullptr : argument_of(argument.back(), scope);
    const std::string_view empty;
    arguments.push_back({words_of(argument, scope),
                         first              ? first->first
                         : argument.empty() ? empty
                                            : argument.front(),
                         last               ? last->last
                         : argument.empty() ? empty
                                            : argument.back()});
    argument.clear();
    if (depth == 0) return at = i + 1, std::move(arguments);
  }
  return std::nullopt;
}

bool Expansions::takes_arguments(std::string_view name) const {
  const auto found = macros_.find(name);
  return found != macros_.end() && std::any_of(found->second.begin(), found->second.end(), [](const Macro& macro) { return macro.has_parameters; });
}

const Expansions::Argument* Expansions::argument_of(std::string_view word, const Scope& scope) {
  if (scope.parameters == nullptr) return nullptr;
  const auto found = std::find(scope.parameters->begin(), scope.parameters->end(), word);
  const auto index = static_cast<size_t>(found - scope.parameters->begin());
  return index < scope.arguments->size() && found != scope.parameters->end() ? &(*scope.arguments)[index] : nullptr;
}

}  // namespace rg::compiler
