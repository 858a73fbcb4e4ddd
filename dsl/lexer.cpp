#include "dsl/lexer.h"

#include <algorithm>
#include <array>
#include <string>

namespace rg::dsl {
namespace {

struct Spelling {
  TokenKind kind;
  std::string_view text;
};
constexpr Spelling kPunctuation[] = {
#define RG_TOKEN(name, description)
#define RG_PUNCTUATION(name, spelling) {TokenKind::name, spelling},
#include "dsl/token_kind.def"
#undef RG_PUNCTUATION
#undef RG_TOKEN
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

struct Lexer {
  FileId file;
  std::string_view text;
  Diagnostics& diagnostics;
  uint32_t at = 0;
  Tokens tokens;

  char peek(uint32_t ahead = 0) const { return at + ahead < text.size() ? text[at + ahead] : '\0'; }
  Span span(uint32_t begin) const { return {file, begin, at}; }
};

bool skip_blanks(Lexer& lexer) {
  bool new_line = lexer.at == 0;
  while (lexer.at < lexer.text.size()) {
    const char c = lexer.peek();
    if (c == '\n') {
      new_line = true;
      ++lexer.at;
    } else if (is_blank(c)) {
      ++lexer.at;
    } else if (c == '/' && lexer.peek(1) == '/') {
      while (lexer.at < lexer.text.size() && lexer.peek() != '\n') ++lexer.at;
    } else {
      break;
    }
  }
  return new_line;
}

void take_digits(Lexer& lexer) {
  while (is_digit(lexer.peek())) ++lexer.at;
}

// `1920x1080`, `160x90x64`
bool take_dimensions(Lexer& lexer) {
  if (lexer.peek() != 'x' || !is_digit(lexer.peek(1))) return false;
  while (lexer.peek() == 'x' && is_digit(lexer.peek(1))) {
    ++lexer.at;
    take_digits(lexer);
  }
  return true;
}

bool take_fraction(Lexer& lexer) {
  bool real = false;
  if (lexer.peek() == '.' && is_digit(lexer.peek(1))) {
    ++lexer.at;
    take_digits(lexer);
    real = true;
  }
  const uint32_t sign = lexer.peek(1) == '-' || lexer.peek(1) == '+' ? 1 : 0;
  if ((lexer.peek() == 'e' || lexer.peek() == 'E') && is_digit(lexer.peek(1 + sign))) {
    lexer.at += 1 + sign;
    take_digits(lexer);
    real = true;
  }
  return real;
}

TokenKind take_number(Lexer& lexer) {
  if (lexer.peek() == '0' && lexer.peek(1) == 'x' && is_hex(lexer.peek(2))) {
    lexer.at += 2;
    while (is_hex(lexer.peek())) ++lexer.at;
    return TokenKind::integer;
  }
  const uint32_t begin = lexer.at;
  take_digits(lexer);
  if (take_dimensions(lexer)) return TokenKind::dimensions;
  if (take_fraction(lexer)) return TokenKind::real;
  const bool dimension_word = lexer.at == begin + 1 && lexer.peek() == 'd' && !is_word(lexer.peek(1));  // 1d 2d 3d
  if (!dimension_word) return TokenKind::integer;
  ++lexer.at;
  return TokenKind::identifier;
}

// `64X64`, `64x 64`, `64 \u00d7 64`: where what was found ends, or a blank behind it, another axis begins.
uint32_t next_axis(const Lexer& lexer) {
  uint32_t ahead = 0;
  while (lexer.peek(ahead) == ' ') ++ahead;
  return is_digit(lexer.peek(ahead)) ? lexer.at + ahead : 0;
}

// What a number was to be that other places write in capitals or with a blank; empty: something else.
std::string meant_dimensions(const Lexer& lexer, std::string_view word) {
  std::string meant(word);
  for (char& c : meant) c = c == 'X' ? 'x' : c;
  const bool numbers =
      std::all_of(meant.begin(), meant.end(), [](char c) { return is_digit(c) || c == 'x'; }) && meant.find("xx") == std::string::npos;
  return numbers && (meant.back() != 'x' || next_axis(lexer) != 0) ? meant : "";
}

TokenKind finish_number(Lexer& lexer, uint32_t begin) {
  const TokenKind kind = take_number(lexer);
  if (!is_letter(lexer.peek())) return kind;
  while (is_word(lexer.peek())) ++lexer.at;
  const std::string_view word = lexer.text.substr(begin, lexer.at - begin);
  Diagnostic& malformed = lexer.diagnostics.report(DiagnosticKind::MalformedNumber, lexer.span(begin), {std::string(word)});
  if (const std::string meant = meant_dimensions(lexer, word); !meant.empty())
    malformed.fix({lexer.file, begin, meant.back() == 'x' ? next_axis(lexer) : lexer.at}, meant);
  return TokenKind::invalid;
}

TokenKind take_string(Lexer& lexer, uint32_t begin) {
  ++lexer.at;
  while (lexer.at < lexer.text.size() && lexer.peek() != '"' && lexer.peek() != '\n') ++lexer.at;
  if (lexer.peek() == '"') {
    ++lexer.at;
  } else {
    lexer.diagnostics.report(DiagnosticKind::UnterminatedString, lexer.span(begin)).fix({lexer.file, lexer.at, lexer.at}, "\"");
  }
  return TokenKind::string;
}

// `64\u00d764`
void suggest_times(const Lexer& lexer, uint32_t begin, Diagnostic& invalid) {
  constexpr std::string_view kTimes = "\u00d7";
  if (lexer.text.substr(begin, kTimes.size()) != kTimes) return;
  uint32_t first = begin, last = begin + static_cast<uint32_t>(kTimes.size());
  while (first > 0 && lexer.text[first - 1] == ' ') --first;
  while (last < lexer.text.size() && lexer.text[last] == ' ') ++last;
  const bool between = first > 0 && is_digit(lexer.text[first - 1]) && last < lexer.text.size() && is_digit(lexer.text[last]);
  if (between) invalid.fix({lexer.file, first, last}, "x");
}

// Whole runs, so that a pasted word of another script is one mistake.
TokenKind take_invalid(Lexer& lexer, uint32_t begin) {
  const bool foreign = static_cast<unsigned char>(lexer.peek()) >= 0x80;  // a word in another script
  const auto fits = [&](char c) {
    if (foreign && is_word(c)) return false;
    return is_word(c) || is_blank(c) || c == '\n' || c == '"' || c == '\0';
  };
  const auto punctuation = [&] {
    for (const Spelling& spelling : kPunctuation)
      if (spelling.text[0] == lexer.peek()) return true;
    return false;
  };
  do ++lexer.at;
  while (lexer.at < lexer.text.size() && !fits(lexer.peek()) && !punctuation());
  std::string shown(lexer.text.substr(begin, lexer.at - begin));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  Diagnostic& invalid = lexer.diagnostics.report(DiagnosticKind::InvalidCharacter, lexer.span(begin), {shown});
  suggest_times(lexer, begin, invalid);
  return TokenKind::invalid;
}

// Names reach C++, GLSL and debuggers, which have limits of their own.
TokenKind finish_name(Lexer& lexer, uint32_t begin) {
  constexpr uint32_t kLongest = 256;
  if (lexer.at - begin <= kLongest) return TokenKind::identifier;
  lexer.diagnostics.report(DiagnosticKind::NameTooLong, lexer.span(begin), {std::to_string(lexer.at - begin), std::to_string(kLongest)});
  return TokenKind::invalid;
}

// As C has them: passed over whole, so that what follows is still read.
void skip_foreign_comment(Lexer& lexer) {
  const uint32_t begin = lexer.at;
  const size_t end = lexer.text.find("*/", begin + 2);
  lexer.at = static_cast<uint32_t>(end == std::string_view::npos ? lexer.text.size() : end + 2);
  const Span opening{lexer.file, begin, begin + 2};
  lexer.diagnostics.report(DiagnosticKind::InvalidCharacter, opening, {"/*"}).note(DiagnosticKind::DidYouMean, opening, {"//"});
}

TokenKind take_token(Lexer& lexer) {
  const uint32_t begin = lexer.at;
  const char c = lexer.peek();
  if (is_letter(c)) {
    while (is_word(lexer.peek())) ++lexer.at;
    return finish_name(lexer, begin);
  }
  if (is_digit(c)) return finish_number(lexer, begin);
  if (c == '"') return take_string(lexer, begin);
  for (const Spelling& spelling : kPunctuation) {
    if (lexer.text.substr(begin, spelling.text.size()) != spelling.text) continue;
    lexer.at += static_cast<uint32_t>(spelling.text.size());
    return spelling.kind;
  }
  return take_invalid(lexer, begin);
}

}  // namespace

const char* name(TokenKind kind) {
  static constexpr const char* kNames[] = {
#define RG_TOKEN(name, description) #name,
#define RG_PUNCTUATION(name, spelling) #name,
#include "dsl/token_kind.def"
#undef RG_PUNCTUATION
#undef RG_TOKEN
  };
  return kNames[static_cast<size_t>(kind)];
}

const char* describe(TokenKind kind) {
  static constexpr const char* kDescriptions[] = {
#define RG_TOKEN(name, description) description,
#define RG_PUNCTUATION(name, spelling) "`" spelling "`",
#include "dsl/token_kind.def"
#undef RG_PUNCTUATION
#undef RG_TOKEN
  };
  return kDescriptions[static_cast<size_t>(kind)];
}

Tokens lex(FileId file, std::string_view text, Diagnostics& diagnostics) {
  Lexer lexer{file, text, diagnostics, 0, {}};
  lexer.tokens.reserve(text.size() / 5 + 1);
  if (text.substr(0, 3) == "\xEF\xBB\xBF") lexer.at = 3;
  while (true) {
    const bool starts_line = skip_blanks(lexer);
    const uint32_t begin = lexer.at;
    if (begin >= text.size()) break;
    if (text.substr(begin, 2) == "/*") {
      skip_foreign_comment(lexer);
      continue;
    }
    const TokenKind kind = take_token(lexer);
    lexer.tokens.push_back({kind, starts_line, begin, lexer.at});
  }
  const auto end = static_cast<uint32_t>(text.size());
  lexer.tokens.push_back({TokenKind::end_of_file, true, end, end});
  return std::move(lexer.tokens);
}

std::vector<Comment> find_comments(std::string_view text) {
  std::vector<Comment> comments;
  bool in_string = false;
  for (uint32_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') in_string = !in_string;
    if (text[at] == '\n') in_string = false;
    if (in_string || text.substr(at, 2) != "//") continue;
    const uint32_t begin = at;
    while (at < text.size() && text[at] != '\n') ++at;
    comments.push_back({begin, at});
  }
  return comments;
}

}  // namespace rg::dsl
