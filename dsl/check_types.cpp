// Structs and the types of their fields.
#include <algorithm>
#include <utility>

#include "dsl/check_state.h"
#include "dsl/format_table.h"
#include "dsl/layout.h"
#include "dsl/reserved.h"

namespace rg::dsl {
namespace {

struct NamedType {
  std::string_view name;
  Scalar scalar;
  uint8_t rows, columns;
};
constexpr NamedType kTypes[] = {
    {"f32", Scalar::f32, 1, 1},   {"i32", Scalar::i32, 1, 1},   {"u32", Scalar::u32, 1, 1},   {"bool", Scalar::boolean, 1, 1},
    {"vec2", Scalar::f32, 2, 1},  {"vec3", Scalar::f32, 3, 1},  {"vec4", Scalar::f32, 4, 1},  {"ivec2", Scalar::i32, 2, 1},
    {"ivec3", Scalar::i32, 3, 1}, {"ivec4", Scalar::i32, 4, 1}, {"uvec2", Scalar::u32, 2, 1}, {"uvec3", Scalar::u32, 3, 1},
    {"uvec4", Scalar::u32, 4, 1}, {"mat3", Scalar::f32, 3, 3},  {"mat4", Scalar::f32, 4, 4},  {"mat3x4", Scalar::f32, 4, 3},
};

const NamedType* find_type(std::string_view name) {
  const auto* at = std::find_if(std::begin(kTypes), std::end(kTypes), [&](const NamedType& row) { return row.name == name; });
  return at == std::end(kTypes) ? nullptr : at;
}

// As other languages call them; only what means the same.
std::string_view type_elsewhere(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"float", "f32"},   {"int", "i32"},     {"uint", "u32"},    {"unsigned", "u32"}, {"int32_t", "i32"}, {"uint32_t", "u32"}, {"float2", "vec2"},
      {"float3", "vec3"}, {"float4", "vec4"}, {"int2", "ivec2"},  {"int3", "ivec3"},   {"int4", "ivec4"},  {"uint2", "uvec2"},  {"uint3", "uvec3"},
      {"uint4", "uvec4"}, {"vec2f", "vec2"},  {"vec3f", "vec3"},  {"vec4f", "vec4"},   {"vec2i", "ivec2"}, {"vec3i", "ivec3"},  {"vec4i", "ivec4"},
      {"vec2u", "uvec2"}, {"vec3u", "uvec3"}, {"vec4u", "uvec4"}, {"mat3x3", "mat3"},  {"mat4x4", "mat4"},
  };
  const auto* at = std::find_if(std::begin(kNames), std::end(kNames), [&](const auto& row) { return row.first == name; });
  return at == std::end(kNames) ? std::string_view() : at->second;
}

Guess guess_type(const Checker& checker, uint32_t module, std::string_view name) {
  if (const std::string_view same = type_elsewhere(name); !same.empty()) return {{std::string(same)}, true};
  std::vector<std::string_view> candidates;
  for (const NamedType& type : kTypes) candidates.push_back(type.name);
  for (const Symbol& symbol : checker.symbols)
    if (symbol.kind == SymbolKind::structure && checker.scopes[module].count(symbol.name.text)) candidates.push_back(symbol.name.text);
  const Guess guess = closest(name, candidates);
  return !guess.words.empty() && find_type(guess.words[0]) ? closest_type(name, candidates) : guess;
}

void report_unknown_type(Checker& checker, uint32_t module, const ast::Expr& name) {
  if (checker.lost_names) return;
  if (report_if_private(checker, module, name.text, name.span)) return;
  Diagnostic diagnostic(DiagnosticKind::UnknownType, name.span, {std::string(name.text)});
  suggest(diagnostic, name.span, guess_type(checker, module, name.text));
  checker.diagnostics.report(std::move(diagnostic));
}

// `color: rgba8`: bytes of the format, as vertices have them. Structs of that name come first.
std::optional<Type> field_type(Checker& checker, uint32_t module, const ast::TypeName& node) {
  const Format format = node.name.kind == ast::ExprKind::name ? find_format(node.name.text) : Format::none;
  if (format == Format::none || peek_symbol(checker, module, node.name)) return element_type(checker, module, node);
  if (is_vertex_format(format)) return packed_type(format);
  checker.report(DiagnosticKind::VertexFormat, node.name.span, {std::string(node.name.text)});
  return std::nullopt;
}

std::optional<Field> read_field(Checker& checker, uint32_t module, const ast::FieldDeclaration& node) {
  constexpr int64_t kMaxLength = 1 << 24;
  const std::optional<Type> element = field_type(checker, module, node.type);
  if (!element) return std::nullopt;
  if (element->record.valid() && !check_not_packed(checker, element->record, node.type.span)) return std::nullopt;
  Field field;
  field.name = std::string(node.name.text);
  field.type = *element;
  field.span = node.name.span;
  if (node.type.unsized) {
    checker.report(DiagnosticKind::UnsizedField, node.type.span, {field.name});
    return std::nullopt;
  }
  if (!node.type.count) return field;
  const auto count = evaluate_integer(checker, nullptr, module, *node.type.count, 1, kMaxLength);
  if (!count) return std::nullopt;
  field.type.count = static_cast<uint32_t>(*count);
  return field;
}

bool read_fields(Checker& checker, uint32_t module, const ast::StructDeclaration& declaration, Struct& record) {
  bool ok = true;
  std::unordered_map<std::string_view, Span> seen;
  for (const ast::FieldDeclaration& node : declaration.fields) {
    if (node.name.empty()) return false;
    const auto [at, fresh] = seen.emplace(node.name.text, node.name.span);
    if (!fresh) report_duplicate(checker, node.name, at->second), ok = false;
    if (reserved_in_glsl(node.name.text))
      checker.report(DiagnosticKind::ReservedName, node.name.span, {std::string(node.name.text), "call the field otherwise"}), ok = false;
    std::optional<Field> field = read_field(checker, module, node);
    if (field) record.fields.push_back(std::move(*field));
    ok = ok && field.has_value();
  }
  return ok;
}

// A block has one layout, for all that it holds.
bool nests_alike(Checker& checker, const Struct& record, bool scalar) {
  for (const Field& field : record.fields) {
    if (!field.type.record.valid()) continue;
    const Struct& inner = checker.program.structs[field.type.record];
    if (is_scalar(inner) == scalar) continue;
    const Span span = scalar ? inner.span : record.span;
    checker.report(DiagnosticKind::OptionDoesNotFit, field.span, {"scalar", scalar ? inner.name : record.name})
        .note(DiagnosticKind::DeclaredHere, inner.span, {inner.name})
        .fix({span.file, span.end, span.end}, " scalar");
    return false;
  }
  return true;
}

constexpr uint32_t kMaxDepth = 100;  // of structs in structs

uint32_t depth_of(const Checker& checker, const Struct& record) {
  uint32_t depth = 1;
  for (const Field& field : record.fields)
    if (field.type.record.valid()) depth = std::max(depth, checker.struct_depths[field.type.record.value] + 1);
  return depth;
}

StructId declare_struct(Checker& checker, uint32_t module, const ast::StructDeclaration& declaration) {
  Struct record;
  record.name = std::string(declaration.name.text);
  record.span = declaration.name.span;
  if (reserved_in_glsl(declaration.name.text)) {
    checker.report(DiagnosticKind::ReservedName, record.span, {record.name, "call the struct otherwise"});
    return {};
  }
  if (declaration.name.empty() || !read_fields(checker, module, declaration, record)) return {};
  if (record.fields.empty()) {
    checker.report(DiagnosticKind::EmptyStruct, record.span, {record.name});
    return {};
  }
  if (!nests_alike(checker, record, declaration.scalar)) return {};
  if (!lay_out(checker.program.structs, record, declaration.scalar)) {
    checker.report(DiagnosticKind::StructTooLarge, record.span, {record.name});
    return {};
  }
  if (!claim_public_name(checker, declaration.name)) return {};
  const uint32_t depth = depth_of(checker, record);
  if (depth > kMaxDepth) {
    checker.report(DiagnosticKind::NestingTooDeep, record.span, {std::to_string(kMaxDepth)});
    return {};
  }
  checker.struct_depths.push_back(depth);
  return checker.program.structs.add(std::move(record));
}

}  // namespace

std::optional<Type> element_type(Checker& checker, uint32_t module, const ast::TypeName& node) {
  if (node.name.kind == ast::ExprKind::error) return std::nullopt;
  Type type;
  if (node.name.kind == ast::ExprKind::name) {
    if (const NamedType* named = find_type(node.name.text)) {
      type.scalar = named->scalar;
      type.rows = named->rows;
      type.columns = named->columns;
      return type;
    }
    if (!peek_symbol(checker, module, node.name)) {
      report_unknown_type(checker, module, node.name);
      return std::nullopt;
    }
  }
  type.record = find_struct(checker, module, node.name);
  if (!type.record.valid()) return std::nullopt;
  return type;
}

bool check_not_packed(Checker& checker, StructId id, Span span) {
  if (!id.valid()) return true;
  const Struct& record = checker.program.structs[id];
  const auto packed = std::find_if(record.fields.begin(), record.fields.end(), [](const Field& field) { return field.type.packed != Format::none; });
  if (packed == record.fields.end()) return true;
  checker.report(DiagnosticKind::PackedInBlock, span, {record.name, packed->name, name(packed->type.packed)})
      .note(DiagnosticKind::DeclaredHere, packed->span, {packed->name});
  return false;
}

StructId find_struct(Checker& checker, uint32_t module, const ast::Expr& name) {
  const auto symbol = find_symbol(checker, module, name, SymbolKind::structure);
  return symbol ? struct_of(checker, *symbol) : StructId{};
}

StructId struct_in_place(Checker& checker, uint32_t module, const ast::StructDeclaration& declaration) {
  const auto at = checker.own_names[module].find(declaration.name.text);
  if (at == checker.own_names[module].end() || checker.symbols[at->second].record != &declaration) return {};  // reported as declared twice
  return struct_of(checker, at->second);
}

StructId struct_of(Checker& checker, uint32_t symbol) {
  if (checker.symbols[symbol].progress == Symbol::Progress::running) {
    const ast::Name name = checker.symbols[symbol].name;
    checker.report(DiagnosticKind::NeedsItself, name.span, {std::string(name.text)});
    checker.symbols[symbol].progress = Symbol::Progress::done;
    return {};
  }
  if (checker.symbols[symbol].progress == Symbol::Progress::open) {
    checker.symbols[symbol].progress = Symbol::Progress::running;
    const Deeper deeper(checker.depth);
    if (checker.depth > kMaxDepth) {
      checker.report(DiagnosticKind::NestingTooDeep, checker.symbols[symbol].name.span, {std::to_string(kMaxDepth)});
      checker.symbols[symbol].progress = Symbol::Progress::done;
      return {};
    }
    const ast::StructDeclaration* in_place = checker.symbols[symbol].record;
    const auto& node = in_place ? *in_place : std::get<ast::StructDeclaration>(*checker.symbols[symbol].declaration);
    checker.symbols[symbol].id = declare_struct(checker, checker.symbols[symbol].module, node).value;
    checker.symbols[symbol].progress = Symbol::Progress::done;
  }
  const uint32_t id = checker.symbols[symbol].id;
  return id == UINT32_MAX ? StructId{} : StructId{size_t{id}};
}

}  // namespace rg::dsl
