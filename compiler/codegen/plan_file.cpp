#include "compiler/codegen/plan_file.h"

#include <bit>
#include <map>
#include <vector>

#include "runtime/plan_fields.h"

namespace rg::compiler {
namespace {

using plan_file::PlanNumber;
using plan_file::PlanRow;

using Words = std::span<const uint32_t>;
struct ByWords {
  bool operator()(Words a, Words b) const { return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end()); }
};
using Modules = std::map<Words, uint32_t, ByWords>;  // to their index in the file

class Writer {
 public:
  explicit Writer(const Modules& modules) : modules_(modules) {}

  template <PlanNumber T>
  void put(T value) {
    if constexpr (std::is_enum_v<T>)
      put(static_cast<std::underlying_type_t<T>>(value));
    else if constexpr (std::is_same_v<T, float>)
      put(std::bit_cast<uint32_t>(value));
    else
      for (size_t i = 0; i < sizeof(T); ++i) text.push_back(static_cast<char>(static_cast<uint64_t>(value) >> 8 * i));
  }
  void put(std::string_view value) {
    put(static_cast<uint32_t>(value.size()));
    text.append(value);
  }
  template <class T, size_t N>
  void put(const T (&values)[N]) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(std::span<const T> rows) {
    put(static_cast<uint32_t>(rows.size()));
    for (const T& row : rows) put(row);
  }
  void put(const ShaderModule& module) { put(module.name), put(module.stage), put(modules_.at(module.words)); }
  template <PlanRow T>
  void put(const T& row) {
    plan_file::each_field(row, [&](const auto&... fields) { (put(fields), ...); });
  }

  std::string text;

 private:
  const Modules& modules_;
};

// In order of first use.
std::vector<Words> number_modules(std::span<const Plan> plans, Modules& modules) {
  std::vector<Words> list;
  for (const Plan& plan : plans)
    for (const ShaderModule& module : plan.shaders)
      if (modules.emplace(module.words, static_cast<uint32_t>(list.size())).second) list.push_back(module.words);
  return list;
}

}  // namespace

std::string emit_plan_file(std::span<const Plan> plans) {
  Modules modules;
  const std::vector<Words> list = number_modules(plans, modules);
  Writer body(modules), file(modules);
  body.put(static_cast<uint32_t>(list.size()));
  for (const Words words : list) body.put(words);
  body.put(plans);
  file.text = plan_file::kMagic;
  file.put(plan_file::kPlanFileVersion), file.put(kPlanVersion), file.put(plan_file::kPlanShape);
  file.put(uint64_t{body.text.size()}), file.put(plan_file::checksum(body.text));
  return file.text + body.text;
}

}  // namespace rg::compiler
