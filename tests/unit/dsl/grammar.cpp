#include "grammar.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include "dsl/lexer.h"

namespace rg::dsl::grammar {
namespace {

// ---- reading ----------------------------------------------------------------------------------------------------

struct Reader {
  std::string text;
  size_t at = 0;

  void skip() {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
  }
  bool is(char c) { return skip(), at < text.size() && text[at] == c; }
  bool accept(char c) { return is(c) && ++at; }
  void expect(char c) {
    if (!accept(c)) throw std::runtime_error(std::string("expected ") + c + " before: " + text.substr(at, 40));
  }
  std::string word() {
    skip();
    const size_t begin = at;
    while (at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_')) ++at;
    return text.substr(begin, at - begin);
  }
};

Node read_choice(Reader& reader);

Node read_part(Reader& reader) {
  Node node;
  if (reader.accept('"')) {
    node.kind = Node::Kind::word;
    const size_t end = reader.text.find('"', reader.at);
    node.text = reader.text.substr(reader.at, end - reader.at);
    reader.at = end + 1;
    return node;
  }
  constexpr std::pair<char, char> kBrackets[] = {{'(', ')'}, {'[', ']'}, {'{', '}'}};
  for (const auto& [open, close] : kBrackets) {
    if (!reader.accept(open)) continue;
    node.kind = open == '[' ? Node::Kind::optional : open == '{' ? Node::Kind::repeated : Node::Kind::sequence;
    node.parts.push_back(read_choice(reader));
    reader.expect(close);
    return node;
  }
  node.text = reader.word();
  if (node.text.empty()) throw std::runtime_error("a part is missing before: " + reader.text.substr(reader.at, 40));
  node.kind = std::isupper(static_cast<unsigned char>(node.text[0])) ? Node::Kind::token : Node::Kind::rule;
  return node;
}

Node read_sequence(Reader& reader) {
  Node node;
  while (!reader.is(';') && !reader.is('|') && !reader.is(')') && !reader.is(']') && !reader.is('}')) node.parts.push_back(read_part(reader));
  return node;
}

Node read_choice(Reader& reader) {
  Node node;
  node.kind = Node::Kind::choice;
  do node.parts.push_back(read_sequence(reader));
  while (reader.accept('|'));
  return node;
}

// ---- sentences ----------------------------------------------------------------------------------------------------

struct Writer {
  const Rules& rules;
  Random& random;
  std::string out;
  std::map<std::string, int> heights;  // by rule: the least number of rules inside one another that end a derivation
};

constexpr int kEndless = 1000;

int height(const Node& node, const std::map<std::string, int>& heights) {
  switch (node.kind) {
    case Node::Kind::word:
    case Node::Kind::token:
    case Node::Kind::optional:
    case Node::Kind::repeated:
      return 0;
    case Node::Kind::rule:
      return heights.contains(node.text) ? heights.at(node.text) + 1 : kEndless;
    default:
      break;
  }
  int result = node.kind == Node::Kind::choice ? kEndless : 0;
  for (const Node& part : node.parts)
    result = node.kind == Node::Kind::choice ? std::min(result, height(part, heights)) : std::max(result, height(part, heights));
  return result;
}

std::map<std::string, int> find_heights(const Rules& rules) {
  std::map<std::string, int> heights;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [name, node] : rules) {
      const int now = height(node, heights);
      if (now >= kEndless || (heights.contains(name) && heights[name] <= now)) continue;
      heights[name] = now;
      changed = true;
    }
  }
  return heights;
}

bool begins_line(const std::string& rule) {
  constexpr std::string_view kRules[] = {"declaration",     "item",          "statement",  "field",  "member",
                                         "sampler_setting", "state_setting", "draw_field", "access", "touch"};
  return std::find(std::begin(kRules), std::end(kRules), rule) != std::end(kRules);
}

std::string token_text(const std::string& kind, Random& random) {
  constexpr const char* kNames[] = {"a", "b", "sun_light", "x1", "_q"};
  if (kind == "NAME") return kNames[random.below(std::size(kNames))];
  if (kind == "INTEGER") return std::to_string(random.below(100));
  if (kind == "REAL") return "1." + std::to_string(random.below(100));
  if (kind == "SIZE") return random.below(2) ? "64x32" : "8x4x2";
  if (kind == "STRING") return "\"part.rg\"";
  if (kind == "UNIT") return "MiB";
  if (kind == "GLSL") return "uniform sampler2D albedo[4];";
  throw std::runtime_error("no token is called " + kind);
}

void write(Writer& writer, const Node& node, int depth);

void write_choice(Writer& writer, const Node& node, int depth) {
  std::vector<const Node*> open;
  for (const Node& part : node.parts)
    if (depth > 0 || height(part, writer.heights) == height(node, writer.heights)) open.push_back(&part);
  write(writer, *open[writer.random.below(open.size())], depth);
}

// Each option and each setting stands once, as the page says.
void write_once_each(Writer& writer, const Node& options, int depth) {
  for (const Node& part : options.parts)
    if (depth > 0 && writer.random.below(4) == 0) write(writer, part, depth - 1);
}

// The sequence of one choice that a rule consists of, or null.
const Node* alternatives(const Writer& writer, const Node& repeated) {
  Node const* part = &repeated.parts[0];
  while (part->kind != Node::Kind::rule && part->parts.size() == 1) part = &part->parts[0];
  const bool once = part->kind == Node::Kind::rule && (part->text == "option" || part->text == "setting");
  return once ? &writer.rules.at(part->text) : nullptr;
}

void write(Writer& writer, const Node& node, int depth) {
  switch (node.kind) {
    case Node::Kind::word:
      writer.out += node.text + " ";
      return;
    case Node::Kind::token:
      writer.out += token_text(node.text, writer.random) + " ";
      return;
    case Node::Kind::rule:
      if (begins_line(node.text)) writer.out += "\n";
      return write(writer, writer.rules.at(node.text), depth - 1);
    case Node::Kind::sequence:
      for (const Node& part : node.parts) write(writer, part, depth);
      return;
    case Node::Kind::choice:
      return write_choice(writer, node, depth);
    case Node::Kind::optional:
      if (depth > 0 && writer.random.below(2)) write(writer, node.parts[0], depth);
      return;
    case Node::Kind::repeated:
      if (const Node* options = alternatives(writer, node)) return write_once_each(writer, *options, depth);
      for (uint64_t left = depth > 0 ? writer.random.below(4) : 0; left > 0; --left) write(writer, node.parts[0], depth);
      return;
  }
}

// ---- recognition ----------------------------------------------------------------------------------------------------

using Ends = std::set<size_t>;  // tokens at which a derivation may end

struct Recogniser {
  const Rules& rules;
  std::string_view text;
  const Tokens& tokens;
  std::map<std::pair<std::string, size_t>, Ends> known;
  size_t furthest = 0;
};

bool is_token(const Recogniser& at, const std::string& kind, size_t token) {
  const TokenKind found = at.tokens[token].kind;
  if (kind == "NAME") return found == TokenKind::identifier;
  if (kind == "INTEGER") return found == TokenKind::integer;
  if (kind == "REAL") return found == TokenKind::real;
  if (kind == "SIZE") return found == TokenKind::dimensions;
  if (kind == "STRING") return found == TokenKind::string;
  constexpr std::string_view kUnits[] = {"bytes", "KB", "MB", "GB", "KiB", "MiB", "GiB"};
  return kind == "UNIT" && std::find(std::begin(kUnits), std::end(kUnits), text_of(at.tokens[token], at.text)) != std::end(kUnits);
}

// To the brace that closes the one before.
size_t skip_glsl(const Recogniser& at, size_t token) {
  for (int depth = 0; at.tokens[token].kind != TokenKind::end_of_file; ++token) {
    if (at.tokens[token].kind == TokenKind::left_brace) ++depth;
    if (at.tokens[token].kind == TokenKind::right_brace && depth-- == 0) break;
  }
  return token;
}

Ends ends_of(Recogniser& at, const Node& node, size_t begin);

Ends ends_of_rule(Recogniser& at, const std::string& rule, size_t begin) {
  const auto key = std::pair(rule, begin);
  const auto found = at.known.find(key);
  if (found != at.known.end()) return found->second;
  const Ends ends = ends_of(at, at.rules.at(rule), begin);
  return at.known[key] = ends;
}

Ends ends_of_parts(Recogniser& at, const Node& node, size_t begin) {
  Ends ends = {begin};
  for (const Node& part : node.parts) {
    Ends next;
    for (const size_t end : ends) next.merge(ends_of(at, part, end));
    ends = std::move(next);
  }
  return ends;
}

Ends ends_of_repeated(Recogniser& at, const Node& node, size_t begin) {
  Ends all = {begin}, open = {begin};
  while (!open.empty()) {
    Ends next;
    for (const size_t end : open)
      for (const size_t more : ends_of(at, node.parts[0], end))
        if (all.insert(more).second) next.insert(more);
    open = std::move(next);
  }
  return all;
}

Ends ends_of(Recogniser& at, const Node& node, size_t begin) {
  at.furthest = std::max(at.furthest, begin);
  switch (node.kind) {
    case Node::Kind::word: {
      // `1d` is one token, `(` another: a word is one token's text.
      const bool fits = at.tokens[begin].kind != TokenKind::end_of_file && text_of(at.tokens[begin], at.text) == node.text;
      return fits ? Ends{begin + 1} : Ends{};
    }
    case Node::Kind::token:
      if (node.text == "GLSL") return {skip_glsl(at, begin)};
      return is_token(at, node.text, begin) ? Ends{begin + 1} : Ends{};
    case Node::Kind::rule:
      return ends_of_rule(at, node.text, begin);
    case Node::Kind::sequence:
      return ends_of_parts(at, node, begin);
    case Node::Kind::choice: {
      Ends ends;
      for (const Node& part : node.parts) ends.merge(ends_of(at, part, begin));
      return ends;
    }
    case Node::Kind::optional: {
      Ends ends = ends_of(at, node.parts[0], begin);
      ends.insert(begin);
      return ends;
    }
    case Node::Kind::repeated:
      return ends_of_repeated(at, node, begin);
  }
  return {};
}

}  // namespace

Rules read(const std::string& page) {
  const size_t begin = page.find("```ebnf\n"), end = page.find("\n```", begin + 1);
  if (begin == std::string::npos || end == std::string::npos) throw std::runtime_error("the page has no block of grammar");
  Reader reader{page.substr(begin + 8, end - begin - 8), 0};
  Rules rules;
  for (reader.skip(); reader.at < reader.text.size(); reader.skip()) {
    const std::string name = reader.word();
    reader.expect('=');
    rules[name] = read_choice(reader);
    reader.expect(';');
  }
  return rules;
}

std::string sentence(const Rules& rules, const std::string& rule, Random& random, int depth) {
  Writer writer{rules, random, {}, find_heights(rules)};
  write(writer, rules.at(rule), depth);
  return writer.out + "\n";
}

Recognised recognise(const Rules& rules, const std::string& rule, std::string_view text) {
  Diagnostics ignored;
  const Tokens tokens = lex(FileId{size_t{0}}, text, ignored);
  Recogniser at{rules, text, tokens, {}, 0};
  const Ends ends = ends_of_rule(at, rule, 0);
  return {ends.contains(tokens.size() - 1), tokens[at.furthest].begin};
}

}  // namespace rg::dsl::grammar
