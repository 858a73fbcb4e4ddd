#include "mutate.h"

#include <algorithm>

#include "dsl/lexer.h"
#include "dsl/source.h"

namespace rg::dsl {
namespace {

Tokens tokens_of(const std::string& text) {
  Diagnostics ignored;
  return lex(FileId{size_t{0}}, text, ignored);
}

void mutate_bytes(std::string& text, Random& random) {
  constexpr const char kBytes[] = "{}()[]<>=+-*/.,:;\"#x09 azA_\n\t\x80\xff";
  if (text.empty()) text = "x";
  const size_t at = random.below(text.size());
  const size_t length = std::min(text.size() - at, 1 + random.below(8));
  switch (random.below(4)) {
    case 0:
      text.erase(at, length);
      break;
    case 1:
      text.insert(at, text.substr(at, length));
      break;
    case 2:
      text[at] = kBytes[random.below(sizeof kBytes - 1)];
      break;
    default:
      text.insert(at, 1, kBytes[random.below(sizeof kBytes - 1)]);
      break;
  }
}

}  // namespace

uint64_t Random::next() {
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  return state * 2685821657736338717ull;
}

TokenMutation mutate_token(const std::string& text, Random& random) {
  const Tokens tokens = tokens_of(text);
  TokenMutation result{text, 1, "nothing"};
  if (tokens.size() < 3) return result;
  const Token target = tokens[random.below(tokens.size() - 1)], other = tokens[random.below(tokens.size() - 1)];
  const std::string old(text_of(target, text)), fresh(text_of(other, text));
  result.line = SourceFile({}, text).position(target.begin).line;
  const uint64_t kind = random.below(3);
  const std::string with = kind == 0 ? "" : kind == 1 ? old + " " + old : fresh;
  result.text.replace(target.begin, old.size(), with);
  result.what = "`" + old + "` -> `" + with + "`";
  return result;
}

std::string mutate(const std::string& text, Random& random) {
  std::string result = text;
  for (uint64_t left = 1 + random.below(4); left > 0; --left) {
    if (random.below(2) == 0)
      result = mutate_token(result, random).text;
    else
      mutate_bytes(result, random);
  }
  return result;
}

}  // namespace rg::dsl
