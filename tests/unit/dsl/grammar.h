// The grammar of docs/language.md, read from the page: makes sentences and recognises texts.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dsl/token.h"
#include "mutate.h"

namespace rg::dsl::grammar {

struct Node {
  enum class Kind { word, token, rule, sequence, choice, optional, repeated } kind = Kind::sequence;
  std::string text;  // the word, the class of tokens, or the rule
  std::vector<Node> parts;
};
using Rules = std::map<std::string, Node>;

// Of the ```ebnf block of a page. Throws std::runtime_error with the place of what cannot be read.
Rules read(const std::string& page);

// A random sentence of `rule`. Deeper than `depth` rules only what ends soonest is taken.
std::string sentence(const Rules& rules, const std::string& rule, Random& random, int depth);

// How many tokens of `text` the longest derivation of a beginning covers; all of them if the text is a sentence of `rule`.
struct Recognised {
  bool whole = false;
  size_t reached = 0;  // byte offset of the first token no derivation gets past
};
Recognised recognise(const Rules& rules, const std::string& rule, std::string_view text);

}  // namespace rg::dsl::grammar
