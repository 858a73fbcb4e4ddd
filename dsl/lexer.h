// TEXT -> TOKENS. Comments and blanks are dropped; a character that fits nowhere becomes an `invalid` token and one diagnostic.
#pragma once

#include "dsl/diagnostics.h"
#include "dsl/token.h"

namespace rg::dsl {

Tokens lex(FileId file, std::string_view text, Diagnostics& diagnostics);

// The comments of a file, in order: what the formatter puts back. Half-open byte ranges.
struct Comment {
  uint32_t begin = 0, end = 0;
  friend bool operator==(const Comment&, const Comment&) = default;
};
std::vector<Comment> find_comments(std::string_view text);

}  // namespace rg::dsl
