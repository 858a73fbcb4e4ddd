// glslang says what the language forbids; here it becomes what the pass forbids, where the two are the same mistake.
#include <algorithm>

#include "compiler/shaders/agreement.h"
#include "compiler/shaders/expansion.h"
#include "compiler/shaders/interface.h"
#include "dsl/closest.h"

namespace rg::compiler {
namespace {

using dsl::Diagnostic;
using dsl::DiagnosticKind;

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

std::string quoted_word(const std::string& message) {
  const size_t begin = message.find('\''), end = message.find('\'', begin + 1);
  return begin == std::string::npos || end == std::string::npos ? "" : message.substr(begin + 1, end - begin - 1);
}

// "'foo' : undeclared identifier " -> "`foo`: undeclared identifier", the house's way to quote
std::string restyle(const std::string& message) {
  const std::string word = quoted_word(message);
  const size_t colon = message.find("' : ");
  if (colon == std::string::npos) return message;
  const std::string rest = message.substr(message.find_first_not_of(' ', colon + 3));
  return word.empty() ? rest : "`" + word + "`: " + rest;
}

// "'#include' : REASON for header name: x.glsl" -> "cannot include `x.glsl`: REASON"
std::string include_text(const std::string& message) {
  constexpr std::string_view kBegin = "'#include' : ", kName = " for header name: ";
  const size_t begin = message.find(kBegin), name = message.rfind(kName);
  if (begin == std::string::npos || name == std::string::npos) return restyle(message);
  const size_t reason = begin + kBegin.size();
  return "cannot include `" + message.substr(name + kName.size()) + "`: " + message.substr(reason, name - reason);
}

std::string plain_text(const dsl::Shader& shader, const ShaderMessage& message) {
  const std::string word = quoted_word(message.text);
  if (contains(message.text, "Missing entry point")) return "`" + shader.path + "` has no `void main()`";
  if (word == "#version") return "rgc writes `#version` in front of every shader: leave the line out";
  return word == "#include" ? include_text(message.text) : restyle(message.text);
}

// How an image is accessed that stands in this line as the first argument of one of GLSL's functions for storage images, or else of those for
// textures.
std::string image_access(const std::string& image, const std::string& name, const std::string& line) {
  const auto is_first_argument = [&](const char* function) {
    const size_t call = line.find(function), open = call == std::string::npos ? call : line.find('(', call);
    const size_t first = open == std::string::npos ? open : line.find_first_not_of(' ', open + 1);
    return first != std::string::npos && line.compare(first, name.size(), name) == 0 &&
           (first + name.size() == line.size() || !is_word(line[first + name.size()]));
  };
  if (is_first_argument("imageStore")) return "write " + image + " as storage";
  if (is_first_argument("imageAtomic")) return "atomic " + image;
  return "read " + image + (is_first_argument("imageLoad") ? " as storage" : " as sampled");
}

// What to write in the pass to get `name`, if the graph has such a thing.
std::string suggestion(const PassContext& context, const std::string& name, const std::string& line) {
  for (const dsl::Resource& resource : context.graph.resources)
    if (last_part(resource.name) == name)
      return resource.kind == dsl::ResourceKind::image ? image_access(resource.name, name, line) : "read " + resource.name + " as storage";
  for (const dsl::Params& params : context.graph.params)
    if (!params.pass.valid() && last_part(params.name) == name) return "params " + params.name;
  for (const dsl::Feature& feature : context.program.features)
    if (last_part(feature.name) == name) return "features " + feature.name;
  return "";
}

// The binding whose name stands in glslang's words or in the offending line.
const dsl::Access* access_meant(const PassContext& context, const std::string& message, const std::string& line, dsl::Mode mode) {
  for (const std::string* text : {&message, &line})
    for (const dsl::Access& access : context.pass.accesses)
      if (access.mode == mode && access.role == dsl::Role::storage && text->find(access.name) != std::string::npos) return &access;
  return nullptr;
}

bool report_contradiction(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  const bool write = contains(message.text, "can't modify a readonly");
  const bool read = contains(message.text, "can't read from writeonly");
  const bool dropped = contains(message.text, "cannot drop memory qualifier");
  if (!write && !read && !dropped) return false;
  const bool through_read = write || (dropped && contains(message.text, "readonly"));
  const std::string line = places.text_of_line(message.file, message.line);
  const dsl::Access* access = access_meant(context, message.text, line, through_read ? dsl::Mode::read : dsl::Mode::write);
  if (access == nullptr) return false;
  const DiagnosticKind kind = through_read ? DiagnosticKind::WriteThroughRead : DiagnosticKind::ReadOfWriteOnly;
  diagnostics.report(kind, places.word_in_line(message.file, message.line, access->name), {access->name, context.pass.name})
      .note(DiagnosticKind::AccessDeclaredHere, access->span, {access->name});
  return true;
}

bool report_undeclared(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  const std::string name = quoted_word(message.text);
  const std::string declaration =
      contains(message.text, "undeclared identifier") ? suggestion(context, name, places.text_of_line(message.file, message.line)) : "";
  if (declaration.empty()) return false;
  diagnostics.report(DiagnosticKind::UndeclaredAccess, places.word_in_line(message.file, message.line, name), {name, context.pass.name})
      .note(DiagnosticKind::DeclareAccess, context.pass.span, {declaration});
  return true;
}

// The struct of what stands before `.field` in the line: `camera.field`, `lights[i].field`.
dsl::StructId struct_before(const PassContext& context, const std::string& line, const std::string& field) {
  size_t at = line.find("." + field);
  if (at == std::string::npos) return {};
  for (int depth = 0; at > 0 && (depth > 0 || line[at - 1] == ']'); --at) depth += line[at - 1] == ']' ? 1 : line[at - 1] == '[' ? -1 : 0;
  const std::string before = line.substr(0, at);
  const auto named = [&](const std::string& name) {
    return before.ends_with(name) && (before.size() == name.size() || !is_word(before[before.size() - name.size() - 1]));
  };
  for (const dsl::Access& access : context.pass.accesses)
    if (named(access.name)) return context.graph.resources[access.resource].element.record;
  for (const dsl::ParamsUse& use : context.pass.params)
    if (named(use.name)) return context.graph.params[use.id].type;
  return named("per_draw") ? context.pass.draw.per_draw : dsl::StructId{};
}

bool report_field(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  if (!contains(message.text, "no such field in structure")) return false;
  const std::string field = quoted_word(message.text);
  const dsl::StructId id = struct_before(context, places.text_of_line(message.file, message.line), field);
  if (!id.valid()) return false;
  const dsl::Struct& record = context.program.structs[id];
  const dsl::Span span = places.word_in_line(message.file, message.line, field);
  std::vector<std::string_view> fields;
  for (const dsl::Field& each : record.fields) fields.push_back(each.name);
  dsl::Diagnostic error(DiagnosticKind::UnknownName, span, {"field of struct `" + record.name + "`", field});
  error.note(DiagnosticKind::DeclaredHere, record.span, {record.name});
  dsl::suggest(error, span, dsl::closest(field, fields));
  diagnostics.report(std::move(error));
  return true;
}

bool report_local_size(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  if (!contains(message.text, "local_size") || !contains(message.text, "cannot change previously set size")) return false;
  const bool told = std::any_of(diagnostics.rows().begin(), diagnostics.rows().end(), [&](const dsl::Diagnostic& each) {
    return each.kind == DiagnosticKind::LocalSizeInShader && each.arguments[0] == context.pass.name;
  });
  if (told) return true;  // a message for each axis
  diagnostics.report(DiagnosticKind::LocalSizeInShader, places.line(message.file, message.line), {context.pass.name})
      .note(DiagnosticKind::GroupOfPass, context.pass.span);
  return true;
}

// Who assigns to a name that is none means an output, and outputs are called what the pass calls its attachments.
void note_outputs(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostic& error) {
  const std::string name = quoted_word(message.text), line = places.text_of_line(message.file, message.line);
  const size_t at = line.find(name), after = at == std::string::npos ? at : line.find_first_of("=;", at);
  if (!contains(message.text, "undeclared identifier") || after == std::string::npos || line[after] != '=') return;
  for (const dsl::Access& access : context.pass.accesses)
    if (access.role == dsl::Role::color) error.note(DiagnosticKind::AccessDeclaredHere, access.span, {access.name});
}

// What a name is in GLSL follows from its declaration, which glslang does not know of.
void note_types(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostic& error) {
  if (!contains(message.text, "no matching overloaded function") && !contains(message.text, "can't use with samplers")) return;
  const dsl::Span line = places.line(message.file, message.line);
  for (const dsl::Access& access : context.pass.accesses)
    if (places.word_in_line(message.file, message.line, access.name) != line)
      error.note(DiagnosticKind::AccessDeclaredHere, access.span, {access.name});
}

// What is sampled without a sampler has texels, and `texture` wants more.
void note_samplers(const PassContext& context, const ShaderMessage& message, ShaderPlaces& places, dsl::Diagnostic& error) {
  const std::string function = quoted_word(message.text);
  if (!contains(message.text, "no matching overloaded function") || !function.starts_with("texture")) return;
  const dsl::Span line = places.line(message.file, message.line);
  for (const dsl::Access& access : context.pass.accesses)
    if (access.role == dsl::Role::sampled && !access.sampler.valid() && places.word_in_line(message.file, message.line, access.name) != line)
      error.note(DiagnosticKind::NeedsSampler, access.span, {access.name, function});
}

// Names that the pass and its vertices give to the stage, where one was meant that it does not have.
void note_names(const PassContext& context, const dsl::Shader& shader, const ShaderMessage& message, dsl::Diagnostic& error) {
  if (!contains(message.text, "undeclared identifier")) return;
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "`" : ", `") + name + "`"; };
  if (shader.stage == dsl::stage_vertex)
    for (const dsl::VertexInput& input : context.pass.draw.vertex)
      for (const dsl::Field& field : context.program.structs[input.type].fields) add(field.name);
  for (const InterfaceBinding& binding : pass_bindings(context.program, context.graph, context.pass))
    if (!binding.name.starts_with("rg_")) add(binding.name);
  for (const dsl::ShaderFeature& feature : context.pass.features)
    if (feature.values.empty())
      add(feature.name);
    else
      for (const std::string& value : feature.values) add(feature.name + "_" + value);
  if (context.pass.draw.per_draw.valid()) add("per_draw");
  if (!names.empty()) error.note(DiagnosticKind::ShaderSees, context.pass.span, {names});
}

// A name the declaration chose and GLSL refuses, `input` for one.
void report_in_prelude(const PassContext& context, const dsl::Shader& shader, const Prelude& prelude, const ShaderMessage& message,
                       dsl::Diagnostics& diagnostics) {
  const bool has_line = message.line >= 1 && message.line <= prelude.size() && prelude[message.line - 1].origin.file.valid();
  const dsl::Span origin = has_line ? prelude[message.line - 1].origin : shader.span;
  diagnostics.report(DiagnosticKind::InterfaceDoesNotCompile, origin, {context.pass.name, restyle(message.text)})
      .note(DiagnosticKind::ShaderOfPass, shader.span, {context.pass.name});
}

}  // namespace

void report_message(const PassContext& context, const dsl::Shader& shader, const Prelude& prelude, const ShaderMessage& message, ShaderPlaces& places,
                    dsl::Diagnostics& diagnostics) {
  if (!message.expands.empty())
    return void(diagnostics
                    .report(DiagnosticKind::ExpandsTooFar, places.word_in_line(message.file, message.line, message.expands),
                            {message.expands, std::to_string(kMostWords)})
                    .note(DiagnosticKind::ShaderOfPass, shader.span, {context.pass.name}));
  if (message.file.empty() && message.line > 0) return report_in_prelude(context, shader, prelude, message, diagnostics);
  if (!message.file.empty() &&
      (report_contradiction(context, message, places, diagnostics) || report_undeclared(context, message, places, diagnostics) ||
       report_field(context, message, places, diagnostics) || report_local_size(context, message, places, diagnostics)))
    return;
  const std::string word = quoted_word(message.text);
  const dsl::Span span = message.file.empty() ? shader.span : places.word_in_line(message.file, message.line, word);
  dsl::Diagnostic error(DiagnosticKind::ShaderDoesNotCompile, span, {plain_text(shader, message)});
  if (!message.file.empty()) note_types(context, message, places, error), note_samplers(context, message, places, error);
  if (!message.file.empty() && shader.stage == dsl::stage_fragment) note_outputs(context, message, places, error);
  if (!message.file.empty() && error.notes.empty()) note_names(context, shader, message, error);
  error.note(DiagnosticKind::ShaderOfPass, shader.span, {context.pass.name});
  diagnostics.report(std::move(error));
}

}  // namespace rg::compiler
