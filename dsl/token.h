// The words of the language: places in a file, with their kind.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace rg::dsl {

enum class TokenKind : uint8_t {
#define RG_TOKEN(name, description) name,
#define RG_PUNCTUATION(name, spelling) name,
#include "dsl/token_kind.def"
#undef RG_PUNCTUATION
#undef RG_TOKEN
};

// Bytes [begin, end) of the file. Keywords are identifiers: they mean something only where they stand.
struct Token {
  TokenKind kind = TokenKind::end_of_file;
  bool starts_line = false;  // nothing but blanks and comments before it on its line
  uint32_t begin = 0, end = 0;
  friend bool operator==(const Token&, const Token&) = default;
};
using Tokens = std::vector<Token>;  // ends with one end_of_file

const char* name(TokenKind kind);      // "dot_dot"
const char* describe(TokenKind kind);  // "`..`", "a name": for messages

inline std::string_view text_of(const Token& token, std::string_view source) { return source.substr(token.begin, token.end - token.begin); }

}  // namespace rg::dsl
