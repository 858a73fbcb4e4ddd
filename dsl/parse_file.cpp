// Files, declarations, graphs and the items in them.
#include <cmath>

#include "dsl/parser.h"
#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

using namespace ast;

std::string_view take_path(Parser& parser, const char* what) {
  if (!parser.is(TokenKind::string)) {
    parser.expected(what);
    return {};
  }
  std::string_view path = parser.word().substr(1);
  if (!path.empty() && path.back() == '"') path.remove_suffix(1);
  parser.take();
  return path;
}

void parse_import(Parser& parser, File& file) {
  parser.take();
  const Span span = parser.here();
  const std::string_view path = take_path(parser, "the path of a file");
  if (!parser.silent) file.imports.push_back({path, span});
}

void parse_target(Parser& parser, File& file) {
  Target target;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  if (parser.accept_word("profile")) {
    const Span span = parser.here();
    const std::string_view path = take_path(parser, "the path of a Vulkan Profiles file");
    if (!parser.silent) file.profiles.push_back({path, span});
    return;
  }
  target.api = parser.expect_one_of("`vulkan` or `profile`", {"vulkan", "profile"});
  if (!parser.silent) target.version = parse_expression(parser, "a version").real;
  if (parser.accept_word("with")) target.with = parser.expect_one_of("`split_barriers`", {"split_barriers"});
  target.span = parser.since(begin);
  if (file.target) file.repeated_target = target.span;
  if (!parser.silent && !file.target) file.target = target;
}

Constant parse_constant(Parser& parser) {
  Constant constant;
  parser.take();
  constant.name = parser.expect_name("the name of the constant");
  parser.expect(TokenKind::equal);
  if (!parser.silent) constant.value = parse_expression(parser, "a value");
  return constant;
}

InterfaceDeclaration parse_interface(Parser& parser) {
  InterfaceDeclaration interface;
  parser.take();
  interface.name = parser.expect_name("the name of the interface");
  parse_block(parser, Level::fields, [&] {
    interface.members.push_back(parse_member(parser));
    parser.accept(TokenKind::comma);
  });
  return interface;
}

SamplerDeclaration parse_sampler(Parser& parser) {
  SamplerDeclaration sampler;
  parser.take();
  sampler.name = parser.expect_name("the name of the sampler");
  sampler.settings = parse_settings(
      parser, {{"filter", "", 1, 0}, {"mip", "", 1, 0}, {"address", "", 1, 0}, {"compare", "", 1, 0}, {"anisotropy", "", 0, 1}}, "a sampler");
  return sampler;
}

#define RG_STENCIL(word)                                                                                                   \
  {word, "test", 1, 0}, {word, "fail", 1, 0}, {word, "depth_fail", 1, 0}, {word, "pass", 1, 0}, {word, "reference", 0, 1}, \
      {word, "read_mask", 0, 1}, {                                                                                         \
    word, "write_mask", 0, 1                                                                                               \
  }

StateDeclaration parse_state(Parser& parser) {
  StateDeclaration state;
  parser.take();
  state.name = parser.expect_name("the name of the state");
  state.settings = parse_settings(parser,
                                  {{"cull", "", 1, 0},
                                   {"front", "", 1, 0},
                                   {"depth", "test", 1, 0},
                                   {"depth", "write", 1, 0},
                                   {"depth", "bounds", 0, 2},
                                   {"bias", "", 0, 2},
                                   {"topology", "", 1, 0},
                                   {"alpha_to_coverage", "", 0, 0},
                                   {"conservative", "", 0, 0},
                                   {"samples", "at", 0, 2, true},
                                   RG_STENCIL("stencil"),
                                   RG_STENCIL("stencil_front"),
                                   RG_STENCIL("stencil_back")},
                                  "a state");
  return state;
}
#undef RG_STENCIL

ConditionDeclaration parse_condition(Parser& parser) {
  ConditionDeclaration condition;
  parser.take();
  condition.name = parser.expect_name("the name of the condition");
  if (parser.silent || !parser.accept(TokenKind::left_bracket)) return condition;
  condition.count = parse_expression(parser, "a number of conditions");
  parser.expect(TokenKind::right_bracket);
  return condition;
}

// The text between the braces is GLSL: only the braces count.
EngineSetDeclaration parse_engine_set(Parser& parser) {
  EngineSetDeclaration set;
  parser.take();
  set.name = parser.expect_name("the name of the set");
  set.set_span = parser.here();
  set.set = parser.is(TokenKind::integer) ? parse_expression(parser).integer : -1;
  const Span open = parser.here();
  if (!parser.expect(TokenKind::left_brace)) return set;
  const uint32_t begin = open.end;
  for (uint32_t depth = 0; !parser.done(); parser.take()) {
    if (parser.is(TokenKind::left_brace)) ++depth;
    if (parser.is(TokenKind::right_brace) && depth-- == 0) break;
  }
  set.glsl = parser.text.substr(begin, parser.peek().begin - begin);
  close_block(parser, open);
  return set;
}

Parameter parse_surface(Parser& parser) {
  Parameter parameter;
  parameter.kind = Parameter::Kind::surface;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  parameter.name = parameter.surface.name = parser.expect_name("the name of the surface");
  if (!parser.accept(TokenKind::colon)) parser.expected("`:` and the surface's format and size");
  parameter.surface.has_error = parser.silent;
  if (!parser.silent) parameter.surface = parse_image_type(parser, std::move(parameter.surface));
  parameter.span = parser.since(begin);
  return parameter;
}

const char* port_type(const Parameter& parameter) { return parameter.kind == Parameter::Kind::image ? "a format" : "an element type"; }

Parameter parse_parameter(Parser& parser) {
  const AllowScope scope(parser);
  const uint32_t begin = parser.peek().begin;
  const bool prefixed = parser.is(TokenKind::identifier, 1);
  if (prefixed && parser.is_word("surface")) return parse_surface(parser);
  Parameter parameter;
  const bool directed = prefixed && (parser.is_word("in") || parser.is_word("out") || parser.is_word("inout"));
  if (directed) {
    parameter.direction = parser.is_word("in")    ? Parameter::Direction::in
                          : parser.is_word("out") ? Parameter::Direction::out
                                                  : Parameter::Direction::inout;
    parser.take();
  }
  if (prefixed && parser.accept_word("params"))
    parameter.kind = Parameter::Kind::params;
  else if (prefixed && parser.accept_word("image"))
    parameter.kind = Parameter::Kind::image;
  else if (prefixed && parser.accept_word("buffer"))
    parameter.kind = Parameter::Kind::buffer;
  else if (prefixed && parser.accept_word("const"))
    parameter.kind = Parameter::Kind::constant;
  parameter.name = parser.expect_name("a parameter");
  const bool typed = parameter.kind == Parameter::Kind::params || parameter.kind == Parameter::Kind::interface;
  const bool port = parameter.kind == Parameter::Kind::image || parameter.kind == Parameter::Kind::buffer;
  if (typed && parser.expect(TokenKind::colon)) parameter.type = parse_place(parser, "a type");
  if (port && !parser.silent && parser.accept(TokenKind::colon)) parameter.type = parse_place(parser, port_type(parameter));
  parameter.span = parser.since(begin);
  return parameter;
}

void parse_parameters(Parser& parser, GraphDeclaration& graph) {
  if (parser.silent || !parser.expect(TokenKind::left_paren)) return;
  if (parser.accept(TokenKind::right_paren)) return;
  do {
    graph.parameters.push_back(parse_parameter(parser));
  } while (!parser.silent && parser.accept(TokenKind::comma));
  close_list(parser, TokenKind::right_paren);
}

For parse_for(Parser& parser) {
  For loop;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  loop.variable = parser.expect_name("a loop variable");
  parser.expect_one_of("`in`", {"in"});
  if (!parser.silent) loop.first = parse_expression(parser, "the first value");
  if (!parser.silent) parser.expect(TokenKind::dot_dot);
  if (!parser.silent) loop.last = parse_expression(parser, "the end of the range");
  loop.span = parser.since(begin);
  parse_items(parser, loop.body);
  return loop;
}

When parse_when(Parser& parser) {
  When when;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  when.term = parse_feature_term(parser);
  when.span = parser.since(begin);
  parse_items(parser, when.body);
  if (!parser.accept_word("else")) return when;
  const Nested nested(parser);
  if (parser.is_word("if") && !parser.is_word("host", 1))
    parser.complain(Diagnostic(DiagnosticKind::UnexpectedToken, parser.here(), {"`when` or `{`", "`if`"}).fix(parser.here(), "when"));
  if (nested.fits && parser.is_word("when"))
    when.otherwise.push_back({parse_when(parser)});
  else
    parse_items(parser, when.otherwise);
  return when;
}

IfHost parse_if(Parser& parser) {
  IfHost branch;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  const bool forgotten = parser.is(TokenKind::identifier) && !parser.is_word("host") && !parser.peek().starts_line &&
                         (parser.is(TokenKind::left_brace, 1) || parser.is(TokenKind::left_bracket, 1));
  if (forgotten) {
    const Span span{parser.file, parser.peek().begin, parser.peek().begin};
    parser.complain(Diagnostic(DiagnosticKind::UnexpectedToken, parser.here(), {"`host`", "`" + std::string(parser.word().substr(0, 40)) + "`"})
                        .fix(span, "host "));
  } else {
    parser.expect_one_of("`host`", {"host"});
  }
  if (!parser.silent) branch.condition = parser.expect_name("a condition");
  if (!parser.silent && parser.accept(TokenKind::left_bracket)) {
    branch.index = parse_expression(parser, "an index");
    parser.expect(TokenKind::right_bracket);
  }
  branch.span = parser.since(begin);
  parse_items(parser, branch.body);
  return branch;
}

// `fog`, `lighting.fog`
Expr parse_qualified(Parser& parser, const char* what) {
  Expr expr;
  const Name first = parser.expect_name(what);
  if (first.empty()) return expr;
  expr.kind = ExprKind::name;
  expr.text = first.text, expr.span = first.span;
  if (!parser.accept(TokenKind::dot)) return expr;
  Expr member;
  member.kind = ExprKind::member;
  member.text = parser.expect_name(what).text;
  member.operands.push_back(std::move(expr));
  member.span = parser.since(first.span.begin);
  return member;
}

// `(depth, inout hdr)`
void parse_use_arguments(Parser& parser, Use& use) {
  if (!parser.expect(TokenKind::left_paren) || parser.accept(TokenKind::right_paren)) return;
  do {
    const bool directed = (parser.is_word("in") || parser.is_word("out") || parser.is_word("inout")) && parser.is(TokenKind::identifier, 1);
    use.directions.push_back(directed ? parser.take_name() : Name{});
    use.arguments.push_back(parse_expression(parser, "an argument"));
  } while (!parser.silent && parser.accept(TokenKind::comma));
  close_list(parser, TokenKind::right_paren);
}

Use parse_use(Parser& parser) {
  Use use;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  const bool named = parser.is(TokenKind::equal, 1) || parser.is(TokenKind::left_bracket, 1);
  if (named) {
    use.instance = parser.expect_name("a name");
    use.index = parse_indices(parser);
    if (!parser.silent) parser.expect(TokenKind::equal);
  }
  if (!parser.silent) use.technique = parse_qualified(parser, "a technique");
  if (!parser.silent) parse_use_arguments(parser, use);
  use.span = parser.since(begin);
  return use;
}

void parse_comparison(Parser& parser, Assertion& assertion) {
  constexpr TokenKind kComparisons[] = {TokenKind::less_equal, TokenKind::less, TokenKind::equal_equal, TokenKind::greater, TokenKind::greater_equal};
  for (const TokenKind kind : kComparisons) {
    if (!parser.is(kind)) continue;
    assertion.comparison = parser.take_name();
    assertion.value = parse_expression(parser, "a number");
    if (!parser.silent && parser.is(TokenKind::identifier) && !parser.peek().starts_line && !parser.is_word("on"))
      assertion.unit = parser.expect_one_of("`KiB`, `MiB`, `GiB`, `KB`, `MB`, `GB` or `bytes`", {"KiB", "MiB", "GiB", "KB", "MB", "GB", "bytes"});
    return;
  }
}

Assertion parse_assertion(Parser& parser) {
  Assertion assertion;
  const uint32_t begin = parser.peek().begin;
  assertion.is_error = parser.is_word("assert");
  parser.take();
  assertion.fact = parser.expect_name("a fact");
  if (!parser.silent && parser.is(TokenKind::left_paren)) assertion.arguments = parse_arguments(parser);
  if (!parser.silent) parse_comparison(parser, assertion);
  if (!parser.silent && parser.is_word("on") && !parser.peek().starts_line) {
    parser.take();
    assertion.on = parser.expect_one_of("`one_queue` or `two_queues`", {"one_queue", "two_queues"});
  }
  assertion.span = parser.since(begin);
  assertion.text = parser.text.substr(begin, assertion.span.end - begin);
  return assertion;
}

// Statements after a `}` too many still belong to the pass before it.
bool rejoin_pass(Parser& parser, std::vector<Item>& items) {
  if (items.empty() || !parser.is(TokenKind::identifier) || !begins_statement(parser.word())) return false;
  auto* pass = std::get_if<PassDeclaration>(&items.back().node);
  if (!pass) return false;
  const Span brace = parser.span(parser.tokens[parser.at - 1]);
  if (!parser.lost_structure) parser.complain({DiagnosticKind::StatementOutsidePass, brace, {std::string(parser.word())}});
  parser.lost_structure = true;
  resynchronise(parser, Level::graph);
  pass->has_error = true;
  if (parser.is(TokenKind::right_brace)) parser.take();
  return true;
}

void complain_about_item(Parser& parser) {
  if (!parser.is(TokenKind::identifier)) return parser.unexpected("`image`, `buffer`, `pass` or another item of a graph");
  Diagnostic diagnostic(DiagnosticKind::UnknownItem, parser.here(), {std::string(parser.word().substr(0, 40))});
  const Guess guess = closest_item(parser.word());
  suggest(diagnostic, parser.here(), guess);
  parser.complain(std::move(diagnostic));
}

void parse_item(Parser& parser, std::vector<Item>& items) {
  const std::string_view word = parser.is(TokenKind::identifier) ? parser.word() : std::string_view();
  if (word == "pass")
    items.push_back({parse_pass(parser)});
  else if (word == "image" || word == "buffer")
    items.push_back({parse_resource(parser)});
  else if (word == "bundle")
    items.push_back({parse_bundle(parser)});
  else if (word == "for")
    items.push_back({parse_for(parser)});
  else if (word == "when")
    items.push_back({parse_when(parser)});
  else if (word == "if")
    items.push_back({parse_if(parser)});
  else if (word == "use")
    items.push_back({parse_use(parser)});
  else if (word == "fuse")
    items.push_back({parse_fuse(parser)});
  else if (word == "assert" || word == "warn")
    items.push_back({parse_assertion(parser)});
  else if (word == "allow")
    parse_allow(parser);
  else if (!rejoin_pass(parser, items))
    complain_about_item(parser);
}

// Items after a `}` too many still belong to the graph before it.
bool rejoin_graph(Parser& parser, File& file) {
  if (file.declarations.empty() || !parser.is(TokenKind::identifier) || !begins_item(parser.word())) return false;
  auto* graph = std::get_if<GraphDeclaration>(&file.declarations.back());
  if (!graph) return false;
  const Span brace = parser.span(parser.tokens[parser.at - 1]);
  if (!parser.lost_structure) parser.complain({DiagnosticKind::ItemOutsideGraph, brace, {std::string(parser.word())}});
  parser.lost_structure = true;
  parser.silent = false;
  graph->has_error = true;
  while (!parser.done() && !parser.accept(TokenKind::right_brace) && !starts_outer(parser, Level::graph)) {
    const size_t before = parser.at;
    parse_item(parser, graph->body);
    if (parser.silent) resynchronise(parser, Level::graph);
    if (parser.at == before) parser.take();
  }
  return true;
}

void complain_about_declaration(Parser& parser) {
  if (!parser.is(TokenKind::identifier)) return parser.unexpected("a declaration");
  Diagnostic diagnostic(DiagnosticKind::UnknownDeclaration, parser.here(), {std::string(parser.word().substr(0, 40))});
  const Guess guess = closest_declaration(parser.word());
  suggest(diagnostic, parser.here(), guess);
  parser.complain(std::move(diagnostic));
}

void parse_module(Parser& parser, File& file) {
  if (!file.module.empty()) parser.complain({DiagnosticKind::RepeatedModule, parser.here(), {}});
  parser.take();
  const Name name = parser.expect_name("the name of the module");
  if (file.module.empty()) file.module = name;
}

StructDeclaration parse_struct_declaration(Parser& parser) {
  parser.take();
  return parse_struct(parser);
}

bool hides_name(std::string_view word) {
  constexpr std::string_view kNamed[] = {"const", "extent", "struct", "interface", "sampler", "state", "feature", "condition", "set", "technique"};
  return std::find(std::begin(kNamed), std::end(kNamed), word) != std::end(kNamed);
}

void parse_any_declaration(Parser& parser, File& file) {
  const std::string_view word = parser.is(TokenKind::identifier) ? parser.word() : std::string_view();
  auto& out = file.declarations;
  if (word == "module")
    parse_module(parser, file);
  else if (word == "import")
    parse_import(parser, file);
  else if (word == "target")
    parse_target(parser, file);
  else if (word == "const")
    out.push_back(parse_constant(parser));
  else if (word == "extent")
    out.push_back(parse_extent(parser));
  else if (word == "struct")
    out.push_back(parse_struct_declaration(parser));
  else if (word == "interface")
    out.push_back(parse_interface(parser));
  else if (word == "sampler")
    out.push_back(parse_sampler(parser));
  else if (word == "state")
    out.push_back(parse_state(parser));
  else if (word == "feature")
    out.push_back(parse_feature(parser));
  else if (word == "condition")
    out.push_back(parse_condition(parser));
  else if (word == "set")
    out.push_back(parse_engine_set(parser));
  else if (word == "spectrum")
    out.push_back(parse_spectrum(parser));
  else if (word == "graph" || word == "technique")
    out.push_back(parse_graph(parser, word == "technique"));
  else if (word == "allow")
    parse_allow(parser);
  else if (!rejoin_graph(parser, file))
    complain_about_declaration(parser);
}

// Half a declaration would only cause more messages; its name counts as lost.
void parse_one_declaration(Parser& parser, File& file) {
  const size_t count = file.declarations.size();
  Name word;
  const bool hides = parser.is_word("private") && parser.is(TokenKind::identifier, 1) && hides_name(text_of(parser.peek(1), parser.text));
  if (hides) word = parser.take_name();
  parse_any_declaration(parser, file);
  file.private_words.resize(file.declarations.size());
  if (file.declarations.size() > count) file.private_words.back() = word;
  const bool half = parser.silent && file.declarations.size() > count && !std::holds_alternative<GraphDeclaration>(file.declarations.back());
  if (half) file.declarations.pop_back(), file.private_words.pop_back();
}

}  // namespace

void parse_items(Parser& parser, std::vector<Item>& items) {
  const AllowScope scope(parser);
  parse_block(parser, Level::graph, [&] { parse_item(parser, items); });
}

GraphDeclaration parse_graph(Parser& parser, bool is_technique) {
  const AllowScope scope(parser);
  GraphDeclaration graph;
  graph.is_technique = is_technique;
  parser.take();
  graph.name = parser.expect_name(is_technique ? "the name of the technique" : "the name of the graph");
  parse_parameters(parser, graph);
  graph.has_error = parser.silent;
  parser.lost_names |= parser.silent;
  parse_block(parser, Level::graph, [&] { parse_item(parser, graph.body); });
  return graph;
}

File parse(FileId file_id, std::string_view text, const Tokens& tokens, Diagnostics& diagnostics) {
  Parser parser{file_id, text, tokens, diagnostics};
  File file;
  file.file = file_id;
  while (!parser.done()) {
    const size_t before = parser.at;
    parse_one_declaration(parser, file);
    if (parser.silent) resynchronise(parser, Level::file);
    if (parser.at == before) parser.take();
  }
  for (Allow& allow : parser.allows)
    if (!allow.scope.file.valid()) allow.scope = {file_id, 0, static_cast<uint32_t>(text.size())};
  file.allows = std::move(parser.allows);
  file.has_error = parser.any_error;
  file.lost_names = parser.lost_names;
  file.lost_structure = parser.lost_structure;
  return file;
}

}  // namespace rg::dsl
