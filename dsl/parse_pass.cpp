// `pass NAME : KIND [queue Q [may]] { statements }`
#include <array>

#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

using ast::PassDeclaration;

ast::BlendOption parse_blend(Parser& parser) {
  ast::BlendOption blend;
  const uint32_t begin = parser.peek().begin;
  blend.op = parser.expect_name("a blend operation");
  if (parser.expect(TokenKind::left_paren)) {
    do {
      blend.factors.push_back(parser.expect_name("a blend factor"));
    } while (!parser.silent && parser.accept(TokenKind::comma));
    parser.expect(TokenKind::right_paren);
  }
  blend.span = parser.since(begin);
  return blend;
}

bool parse_access_option(Parser& parser, ast::AccessStatement& access) {
  if (parser.is_word("as") && !access.usage) {
    parser.take();
    access.usage = parse_usage(parser);
  } else if (parser.is_word("clear") && !access.clear && !parser.peek().starts_line) {
    parser.take();
    access.clear = parse_expression(parser, "a clear value");
  } else if (parser.is_word("blend") && !access.blend) {
    parser.take();
    access.blend = parse_blend(parser);
  } else if (parser.is_word("in") && access.stages.empty()) {
    parser.take();
    access.stages = parse_stages(parser);
  } else if (parser.is_word("covers") && !access.covers) {
    access.covers = true;
    parser.take();
  } else if (parser.is_word("disjoint") && !access.disjoint) {
    access.disjoint = true;
    parser.take();
  } else if (parser.is_word("readonly") && !access.readonly) {
    access.readonly = true;
    parser.take();
  } else {
    return false;
  }
  return true;
}

ast::AccessStatement parse_access(Parser& parser, ast::Verb verb) {
  ast::AccessStatement access;
  const uint32_t begin = parser.peek().begin;
  access.verb = verb;
  parser.take();
  if (parser.is(TokenKind::identifier) && parser.is(TokenKind::equal, 1)) {
    access.rename = parser.take_name();
    parser.take();
  }
  access.target = parse_place(parser, "a resource");
  while (!parser.silent && parse_access_option(parser, access)) continue;
  access.span = parser.since(begin);
  complain_about_rest(parser, {"as", "clear", "blend", "covers", "disjoint", "readonly", "in"}, begin);
  return access;
}

// `scan z Stretch associative`
void parse_scan(Parser& parser, ast::ShaderStatement& shader) {
  parser.take();
  shader.scan = parser.expect_one_of("`x`, `y` or `z`", {"x", "y", "z"});
  if (!parser.silent && parser.is(TokenKind::identifier) && !parser.next_begins()) shader.carry = parse_type(parser);
  if (!parser.silent && !shader.carry) parser.expected("the type of what is carried along");
  if (!parser.silent) shader.associative = parser.accept_word("associative");
}

ast::ShaderStatement parse_shader(Parser& parser) {
  ast::ShaderStatement shader;
  const uint32_t begin = parser.peek().begin;
  shader.fullscreen = parser.is_word("fullscreen");
  shader.block = parser.is_word("block");
  parser.take();
  do {
    if (!parser.is(TokenKind::string)) {
      parser.expected("the path of a shader");
      break;
    }
    std::string_view path = parser.word().substr(1);
    if (!path.empty() && path.back() == '"') path.remove_suffix(1);
    shader.paths.push_back({path, parser.here()});
    parser.take();
  } while (parser.is(TokenKind::string));
  if (!parser.silent && parser.accept_word("group") && !complain_about_axes(parser, AxesForm::group))
    for (int axis = 0; axis < 3 && parser.is(TokenKind::integer) + parser.is(TokenKind::identifier) + parser.is(TokenKind::left_paren) > 0; ++axis) {
      if (axis > 0 && (parser.peek().starts_line || (shader.block && parser.is_word("scan")))) break;
      shader.group.push_back(parse_expression(parser, "a group size"));
    }
  if (!parser.silent && shader.block && parser.is_word("scan")) parse_scan(parser, shader);
  shader.span = parser.since(begin);
  complain_about_rest(parser, {"group", "scan", "associative"}, begin);
  return shader;
}

ast::DispatchStatement parse_dispatch(Parser& parser) {
  ast::DispatchStatement dispatch;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  dispatch.how = parser.expect_one_of("`over`, `groups`, `indirect` or `host`", {"over", "groups", "indirect", "host"});
  if (!parser.silent && dispatch.how.text != "host") dispatch.size = parse_size(parser);
  dispatch.span = parser.since(begin);
  complain_about_rest(parser, {});
  return dispatch;
}

ast::PerDraw parse_per_draw(Parser& parser) {
  ast::PerDraw per_draw;
  parser.take();
  const bool scalar = parser.is_word("scalar", 1) && parser.is(TokenKind::left_brace, 2);
  if (parser.is(TokenKind::identifier) && (parser.is(TokenKind::left_brace, 1) || scalar)) {
    per_draw.declaration = parse_struct(parser);
    per_draw.name = per_draw.declaration->name;
  } else {
    per_draw.type = parse_place(parser, "a struct");
  }
  return per_draw;
}

void parse_draw_block(Parser& parser, ast::DrawStatement& draw) {
  if (!parser.is(TokenKind::left_brace)) return;
  parse_block(parser, Level::fields, [&] {
    if (parser.is_word("per_draw") && !draw.per_draw) {
      draw.per_draw = parse_per_draw(parser);
    } else if (parser.is_word("vertex") || parser.is_word("instance")) {
      const bool per_instance = parser.take_name().text == "instance";
      draw.vertex.push_back({parse_place(parser, "a struct"), per_instance});
    } else {
      parser.unexpected("`per_draw`, `vertex` or `instance`");
    }
  });
}

void parse_indirect(Parser& parser, ast::DrawStatement& draw) {
  draw.indirect = true;
  if (parser.expect_one_of("`indirect`", {"indirect"}).empty()) return;
  draw.arguments = parse_place(parser, "a buffer of draw arguments");
  if (!parser.silent && parser.accept_word("max")) draw.max_draws = parse_expression(parser, "a number of draws");
  if (!parser.silent && parser.accept_word("count")) draw.counts = parse_place(parser, "a buffer that holds the count");
}

// `draw 36 instances 8 first 3`, `draw indexed 36 instances 8 first 3 offset 24`
void parse_direct(Parser& parser, ast::DrawStatement& draw) {
  draw.vertices =
      parse_expression(parser, draw.indexed ? "a number of indices, or `indirect`" : "a number of vertices, `indirect`, `indexed` or `host`");
  if (!parser.silent && parser.accept_word("instances")) draw.instances = parse_expression(parser, "a number of instances");
  if (!parser.silent && parser.accept_word("first")) draw.first = parse_expression(parser, draw.indexed ? "the first index" : "the first vertex");
  if (!parser.silent && draw.indexed && parser.accept_word("offset")) draw.offset = parse_expression(parser, "what is added to every index");
}

ast::DrawStatement parse_draw(Parser& parser) {
  ast::DrawStatement draw;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  if (parser.accept_word("host")) {
    draw.host = true;
  } else {
    draw.indexed = parser.accept_word("indexed");
    parser.is_word("indirect") ? parse_indirect(parser, draw) : parse_direct(parser, draw);
  }
  draw.span = parser.since(begin);
  if (!parser.silent) parse_draw_block(parser, draw);
  complain_about_rest(parser, {"max", "count", "instances", "first", "offset"}, begin);
  return draw;
}

ast::TransferStatement parse_transfer(Parser& parser) {
  ast::TransferStatement transfer;
  const uint32_t begin = parser.peek().begin;
  transfer.verb = parser.take_name();
  const std::string_view verb = transfer.verb.text;
  const bool pair = verb == "copy" || verb == "blit" || verb == "resolve";
  if (pair) {
    transfer.src = parse_place(parser, "a resource");
    if (!parser.silent) parser.expect(TokenKind::arrow);
  }
  if (!parser.silent) transfer.dst = parse_place(parser, "a resource");
  if (!parser.silent && (verb == "clear" || verb == "fill")) transfer.value = parse_expression(parser, "a value");
  if (!parser.silent && verb == "blit") transfer.linear = parser.accept_word("linear");
  transfer.span = parser.since(begin);
  complain_about_rest(parser, {"linear"}, begin);
  return transfer;
}

ast::HostTransfer parse_host_transfer(Parser& parser) {
  ast::HostTransfer host;
  host.span = parser.here();
  parser.take();
  bool told = false;
  parse_block(parser, Level::pass, [&] {
    if (parser.is_word("read") || parser.is_word("write") || parser.is_word("update"))
      host.accesses.push_back(parse_access(parser, parser.is_word("read")    ? ast::Verb::read
                                                   : parser.is_word("write") ? ast::Verb::write
                                                                             : ast::Verb::update));
    else if (told)
      parser.silent = true;
    else
      told = true, parser.unexpected("`read`, `write` or `update`");
  });
  return host;
}

ast::ParamsStatement parse_params(Parser& parser) {
  ast::ParamsStatement params;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  params.name = parser.expect_name("the name of a parameter block");
  if (!parser.silent && parser.accept(TokenKind::colon)) params.type = parse_place(parser, "a struct");
  params.span = parser.since(begin);
  complain_about_rest(parser, {});
  return params;
}

ast::WordStatement parse_word_statement(Parser& parser) {
  ast::WordStatement statement;
  const uint32_t begin = parser.peek().begin;
  statement.word = parser.take_name();
  if (statement.word.text != "keep" && statement.word.text != "multiview") statement.value = parse_place(parser, "a name");
  statement.span = parser.since(begin);
  complain_about_rest(parser, {});
  return statement;
}

struct VerbWord {
  std::string_view word;
  ast::Verb verb;
};
constexpr VerbWord kVerbs[] = {{"read", ast::Verb::read},      {"write", ast::Verb::write}, {"update", ast::Verb::update},
                               {"atomic", ast::Verb::atomic},  {"color", ast::Verb::color}, {"depth", ast::Verb::depth},
                               {"stencil", ast::Verb::stencil}};

// `update RES` alone is the transfer of host bytes; with `as` it is an access, and with `clear` and a value, which no statement begins with.
bool is_transfer_update(const Parser& parser, const PassDeclaration& pass) {
  if (!parser.is_word("update") || pass.kind.text != "transfer") return false;
  for (size_t ahead = 1; !parser.peek(ahead).starts_line && !parser.is(TokenKind::right_brace, ahead); ++ahead)
    if (parser.is_word("as", ahead) || (ahead > 1 && parser.is_word("clear", ahead) && !parser.is(TokenKind::identifier, ahead + 1))) return false;
  return true;
}

ast::Statement parse_other(Parser& parser) {
  const std::string_view word = parser.word();
  if (word == "shader" || word == "fullscreen" || word == "block") return parse_shader(parser);
  if (word == "dispatch") return parse_dispatch(parser);
  if (word == "draw") return parse_draw(parser);
  if (word == "params") return parse_params(parser);
  if (word == "features") return parse_features(parser);
  if (word == "spectrum") return parse_spectrum_statement(parser);
  if (word == "host") return parse_host_transfer(parser);
  if (word == "copy" || word == "blit" || word == "clear" || word == "fill" || word == "resolve") return parse_transfer(parser);
  return parse_word_statement(parser);
}

void complain_about_statement(Parser& parser) {
  if (!parser.is(TokenKind::identifier)) return parser.unexpected("a statement");
  Diagnostic diagnostic(DiagnosticKind::UnknownStatement, parser.here(), {std::string(parser.word().substr(0, 40))});
  const Guess guess = closest_statement(parser.word());
  suggest(diagnostic, parser.here(), guess);
  parser.complain(std::move(diagnostic));
}

void parse_statement(Parser& parser, PassDeclaration& pass) {
  const size_t count = pass.statements.size();
  if (parser.is_word("allow")) {
    parse_allow(parser);
    complain_about_rest(parser, {});
  } else if (!parser.is(TokenKind::identifier) || !begins_statement(parser.word())) {
    complain_about_statement(parser);
  } else if (is_transfer_update(parser, pass)) {
    pass.statements.push_back(parse_transfer(parser));
  } else {
    const auto* verb = std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const VerbWord& row) { return parser.is_word(row.word); });
    pass.statements.push_back(verb == std::end(kVerbs) ? parse_other(parser) : ast::Statement(parse_access(parser, verb->verb)));
  }
  if (!parser.silent) return;
  pass.has_error = true;
  if (pass.statements.size() > count) pass.statements.pop_back();  // half a statement would only cause more messages
}

void parse_queue(Parser& parser, PassDeclaration& pass) {
  if (parser.silent || !parser.accept_word("queue")) return;
  pass.queue = parser.expect_one_of("`graphics`, `compute` or `transfer`", {"graphics", "compute", "transfer"});
  pass.queue_may = parser.accept_word("may");
}

// Where the statement that begins at `begin` has an option already that stands here once more; an empty span: it has not.
Span first_of_option(const Parser& parser, const std::vector<std::string_view>& options, uint32_t begin) {
  if (std::find(options.begin(), options.end(), parser.word()) == options.end()) return {};
  for (size_t at = parser.at; at-- > 0 && parser.tokens[at].begin > begin;)
    if (parser.tokens[at].kind == TokenKind::identifier && text_of(parser.tokens[at], parser.text) == parser.word())
      return parser.span(parser.tokens[at]);
  return {};
}

}  // namespace

void complain_about_rest(Parser& parser, const std::vector<std::string_view>& options, uint32_t begin) {
  if (parser.silent || parser.peek().starts_line || parser.is(TokenKind::right_brace)) return;
  if (parser.is(TokenKind::identifier) && begins_statement(parser.word())) return;
  if (!parser.is(TokenKind::identifier)) return parser.unexpected("the end of the statement");
  if (const Span first = first_of_option(parser, options, begin); first.file.valid()) {
    Diagnostic twice(DiagnosticKind::RepeatedSetting, parser.here(), {std::string(parser.word())});
    twice.note(DiagnosticKind::FirstIsHere, first);
    return parser.complain(std::move(twice));
  }
  Diagnostic diagnostic(DiagnosticKind::UnknownOption, parser.here(), {std::string(parser.word().substr(0, 40))});
  const Guess guess = closest(parser.word(), options);
  suggest(diagnostic, parser.here(), guess);
  parser.complain(std::move(diagnostic));
}

void parse_pass_body(Parser& parser, PassDeclaration& pass) {
  pass.has_error |= parser.silent;
  parse_block(parser, Level::pass, [&] { parse_statement(parser, pass); });
}

ast::BundleDeclaration parse_bundle(Parser& parser) {
  const AllowScope scope(parser);
  ast::BundleDeclaration bundle;
  PassDeclaration body;
  parser.take();
  bundle.name = parser.expect_name("the name of the bundle");
  parser.lost_names |= bundle.name.empty();
  parse_pass_body(parser, body);
  bundle.statements = std::move(body.statements);
  bundle.has_error = body.has_error;
  return bundle;
}

PassDeclaration parse_pass(Parser& parser) {
  const AllowScope scope(parser);
  PassDeclaration pass;
  parser.take();
  pass.name = parser.expect_name("the name of the pass");
  pass.index = parse_indices(parser);
  pass.span = parser.since(pass.name.span.begin);
  if (!parser.silent) parser.expect(TokenKind::colon);
  pass.kind = parser.expect_one_of("`raster`, `compute`, `transfer` or `host`", {"raster", "compute", "transfer", "host"});
  parse_queue(parser, pass);
  parse_pass_body(parser, pass);
  return pass;
}

}  // namespace rg::dsl
