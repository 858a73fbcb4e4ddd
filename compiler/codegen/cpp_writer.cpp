#include "compiler/codegen/cpp_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <set>

namespace rg::compiler {
namespace {

constexpr size_t kColumns = 150;

const std::set<std::string_view>& keywords() {
  static const std::set<std::string_view> words = {
      "alignas",  "alignof",   "and",      "asm",       "auto",     "bitand",   "bitor",     "bool",      "break",     "case",
      "catch",    "char",      "class",    "compl",     "concept",  "const",    "consteval", "constexpr", "constinit", "continue",
      "co_await", "co_return", "co_yield", "decltype",  "default",  "delete",   "do",        "double",    "else",      "enum",
      "explicit", "export",    "extern",   "false",     "float",    "for",      "friend",    "goto",      "if",        "inline",
      "int",      "long",      "mutable",  "namespace", "new",      "noexcept", "not",       "nullptr",   "operator",  "or",
      "private",  "protected", "public",   "register",  "requires", "return",   "short",     "signed",    "sizeof",    "static",
      "struct",   "switch",    "template", "this",      "throw",    "true",     "try",       "typedef",   "typeid",    "typename",
      "union",    "unsigned",  "using",    "virtual",   "void",     "volatile", "while",     "xor",       "linux",     "unix"};
  return words;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string cpp_name(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (is_word(c))
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  if (result.empty() || std::isdigit(static_cast<unsigned char>(result[0]))) result = "n" + result;
  if (keywords().contains(result)) result += '_';
  return result;
}

std::string cpp_type_name(std::string_view name) {
  std::string result;
  bool upper = true;
  for (const char c : cpp_name(name)) {
    if (c == '_') {
      upper = true;
      continue;
    }
    const bool digits_meet =
        upper && std::isdigit(static_cast<unsigned char>(c)) && !result.empty() && std::isdigit(static_cast<unsigned char>(result.back()));
    if (digits_meet) result += '_';
    result += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return result;
}

std::string cpp_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + "\"";
}

std::string cpp_float(float value) {
  std::array<char, 48> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::vector<std::string> distinct(std::vector<std::string> names) {
  std::set<std::string> taken;
  for (std::string& name : names) {
    std::string candidate = name;
    for (int number = 2; !taken.insert(candidate).second; ++number) candidate = name + "_" + std::to_string(number);
    name = candidate;
  }
  return names;
}

Row& Row::field(std::string_view name, std::string value) {
  fields_.push_back("." + std::string(name) + " = " + std::move(value));
  return *this;
}
Row& Row::number(std::string_view name, uint64_t value, uint64_t omitted) { return value == omitted ? *this : field(name, std::to_string(value)); }
Row& Row::flag(std::string_view name, bool value) { return value ? field(name, "true") : *this; }
Row& Row::string(std::string_view name, std::string_view value) { return value.empty() ? *this : field(name, cpp_string(value)); }
Row& Row::nested(std::string_view name, const Row& row) { return row.empty() ? *this : field(name, row.inline_text()); }
Row& Row::comment(std::string text) {
  comment_ = std::move(text);
  return *this;
}

std::string Row::inline_text() const {
  std::string text = "{";
  for (size_t i = 0; i < fields_.size(); ++i) text += (i > 0 ? ", " : "") + fields_[i];
  return text + "}";
}

// What stays on one line: a field, or, where that is too long for any, a field of what is nested in it.
std::vector<std::string> Row::pieces(size_t width) const {
  std::vector<std::string> all;
  for (size_t i = 0; i < fields_.size(); ++i) {
    std::string rest = fields_[i] + (i + 1 == fields_.size() ? "}," : ", ");
    const bool quotes = rest.find('"') != std::string::npos;
    for (size_t cut = quotes ? std::string::npos : rest.find(", ."); rest.size() > width && cut != std::string::npos; cut = rest.find(", .")) {
      all.push_back(rest.substr(0, cut + 2));
      rest.erase(0, cut + 2);
    }
    all.push_back(std::move(rest));
  }
  return all;
}

std::string Row::lines(size_t indent) const {
  const std::string margin(indent, ' ');
  std::string text, line = margin + "{";
  for (const std::string& piece : pieces(kColumns - indent)) {
    if (line.size() + piece.size() > kColumns + 1 && line.size() > indent + 1) {
      while (line.back() == ' ') line.pop_back();
      text += line + "\n";
      line = margin + " ";
    }
    line += piece;
  }
  if (fields_.empty()) line += "},";
  if (comment_.empty()) return text + line + "\n";
  if (line.size() + 4 + comment_.size() <= kColumns) return text + line + "  // " + comment_ + "\n";
  return margin + "// " + comment_ + "\n" + text + line + "\n";
}

CppWriter& CppWriter::line(std::string_view text) {
  text_ += text;
  text_ += '\n';
  return *this;
}

CppWriter& CppWriter::call(const std::string& before, const std::vector<std::string>& items, const std::string& after) {
  const std::string margin(before.size() + 1, ' ');
  std::string current = before + "(";
  for (size_t i = 0; i < items.size(); ++i) {
    const bool last = i + 1 == items.size();
    const std::string piece = items[i] + (last ? ")" + after : ",");
    const bool fresh = current.back() == '(' || current == margin;
    if (!fresh && current.size() + 1 + piece.size() > kColumns) {
      line(current);
      current = margin;
    }
    current += (current.back() == '(' || current == margin ? "" : " ") + piece;
  }
  return line(items.empty() ? current + ")" + after : current);
}

void CppWriter::table(const std::string& type, const std::string& name, const std::vector<Row>& rows) {
  if (rows.empty()) return;
  line("constexpr " + type + " " + name + "[] = {");
  for (const Row& row : rows) text_ += row.lines(4);
  line("};");
  line();
}

}  // namespace rg::compiler
