// C++ text: lines, designated initialisers that wrap, names that C++ accepts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rg::compiler {

// "bloom_down[3]" -> "bloom_down_3", "scene.lights" -> "scene_lights", "default" -> "default_".
std::string cpp_name(std::string_view name);
// "gbuffer_world" -> "GbufferWorld"
std::string cpp_type_name(std::string_view name);
std::string cpp_string(std::string_view text);  // quoted and escaped
std::string cpp_float(float value);             // shortest text that reads back as the same float
// Distinct names for distinct rows, in order: a later equal one gets a number.
std::vector<std::string> distinct(std::vector<std::string> names);

// One braced initialiser. Fields that hold their default are left out by the caller.
class Row {
 public:
  Row& field(std::string_view name, std::string value);
  Row& number(std::string_view name, uint64_t value, uint64_t omitted = 0);
  Row& flag(std::string_view name, bool value);  // true only
  Row& string(std::string_view name, std::string_view value);
  Row& nested(std::string_view name, const Row& row);  // unless empty
  Row& comment(std::string text);
  bool empty() const { return fields_.empty(); }
  std::string inline_text() const;
  // Indented, wrapped between fields at column 150, with a trailing comma and the comment.
  std::string lines(size_t indent) const;

 private:
  std::vector<std::string> pieces(size_t width) const;

  std::vector<std::string> fields_;
  std::string comment_;
};

class CppWriter {
 public:
  CppWriter& line(std::string_view text = "");
  // `BEFORE(ITEMS)AFTER`, broken between items where it is too wide.
  CppWriter& call(const std::string& before, const std::vector<std::string>& items, const std::string& after);
  // `constexpr TYPE NAME[] = { rows };` Nothing at all for an empty table. A comment per row may come before it.
  void table(const std::string& type, const std::string& name, const std::vector<Row>& rows);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace rg::compiler
