// Private to the files that print plan tables.
#pragma once

#include <initializer_list>
#include <span>

#include "compiler/codegen/emit_plan.h"

namespace rg::compiler {

// Adds an index unless it is kNone.
Row& index(Row& row, std::string_view name, Index value);
// Adds a slice of another table unless it is empty.
Row& slice(Row& row, const std::string& first, Index at, const std::string& count, uint32_t size);
// "Lifetime::history"
std::string enum_text(const char* type, size_t value, std::initializer_list<const char*> names);
// Adds an enumerator unless it is the first, which every field of plan.h holds by default.
Row& enumerator(Row& row, const char* field, const char* type, size_t value, std::initializer_list<const char*> names);
Row clear_value(const ClearValue& value);
std::string dimension_text(Dimension dimension);
std::string format_text(Format format);
// The pass that owns row `at` of a table that passes slice.
std::string owner(const Plan& plan, size_t at, Index Pass::*first, uint32_t Pass::*count);
// Tables of numbers and strings; sixteen items a line.
void list(CppWriter& out, const std::string& type, const std::string& name, const std::vector<std::string>& items);
std::vector<std::string> numbers(std::span<const Index> indices);

// One plan becoming text. Each member function adds some tables, and is defined in the file that says so.
class PlanEmitter {
 public:
  PlanEmitter(const Plan& plan, const PlanText& text) : plan_(plan), text_(text) {}
  std::string run();

 private:
  std::string resource(Index i) const { return i == kNone ? "kNone" : "resource::" + text_.names.resources[i]; }
  std::string pass(Index i) const { return i == kNone ? "kNone" : "pass::" + text_.names.passes[i]; }
  Row& declared(Row& row, dsl::Span span) const;

  Row ref(const Ref& ref) const;
  Row range(const Range& range) const;
  Row bytes(const Bytes& bytes) const;
  Row scopes(Row row, Stages src_stages, Accesses src_accesses, Stages dst_stages, Accesses dst_accesses, BarrierTag tag) const;

  // emit_plan.cpp
  void values();
  void resources();
  void frame();
  void passes();
  void transfers();
  void plan();
  // emit_barriers.cpp
  std::string flow(const Ref& ref, size_t step) const;
  std::string group_comment(Index group) const;
  void barriers();
  void boundaries();
  // emit_pipelines.cpp
  void rendering();
  void pipelines();
  void bindings();

  template <class T, class F>
  void table(const char* type, const char* name, std::span<const T> rows, F row) {
    std::vector<Row> texts;
    for (size_t i = 0; i < rows.size(); ++i) texts.push_back(row(rows[i], i));
    out_.table(type, name, texts);
  }

  const Plan& plan_;
  const PlanText& text_;
  CppWriter out_;
};

}  // namespace rg::compiler
