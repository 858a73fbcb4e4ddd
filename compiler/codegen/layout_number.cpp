#include "compiler/codegen/layout_number.h"

#include <fmt/format.h>

#include <map>

#include "runtime/plan_fields.h"

namespace rg::compiler {
namespace {

uint32_t number(const std::string& text) {
  const uint64_t sum = plan_file::checksum(text);
  return static_cast<uint32_t>(sum ^ sum >> 32);
}

// Remembers structs: one may be named many times over.
class Layouts {
 public:
  explicit Layouts(const dsl::Program& program) : program_(program) {}

  // "0x3x1", "0x4x4[2]", "#8f3a0011"
  std::string text(const dsl::Type& type) {
    std::string one = type.record.valid() ? fmt::format("#{:08x}", of_struct(type.record))
                                          : fmt::format("{}x{}x{}", static_cast<int>(type.scalar), type.rows, type.columns);
    if (type.packed != dsl::Format::none) one += fmt::format("~{}", dsl::name(type.packed));
    return type.count == 0 ? one : one + fmt::format("[{}]", type.count);
  }
  uint32_t of_struct(dsl::StructId record) {
    if (const auto known = numbers_.find(record.value); known != numbers_.end()) return known->second;
    std::string all;
    for (const dsl::Field& field : program_.structs[record].fields)
      all += fmt::format("{}:{}@{}/{} ", field.name, text(field.type), field.offset140, field.offset430);
    return numbers_[record.value] = number(all);
  }

 private:
  const dsl::Program& program_;
  std::map<uint32_t, uint32_t> numbers_;
};

}  // namespace

uint32_t layout_of_struct(const dsl::Program& program, dsl::StructId record) { return Layouts(program).of_struct(record); }

uint32_t layout_of_elements(const dsl::Program& program, const dsl::Resource& resource) {
  return resource.kind == dsl::ResourceKind::buffer ? number(Layouts(program).text(resource.element)) : 0;
}

uint32_t layout_of_values(const dsl::Feature& feature) {
  if (feature.values == std::vector<std::string>{"off", "on"}) return 0;
  std::string all;
  for (const std::string& value : feature.values) all += value + " ";
  return number(all);
}

}  // namespace rg::compiler
