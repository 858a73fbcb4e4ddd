// `image NAME : FORMAT SIZE settings`, `buffer NAME : T[n] settings`, members of interfaces.
#include <algorithm>

#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

constexpr SettingShape kResourceSettings[] = {
    {"mips", "", 0, 1},          {"layers", "", 0, 1},   {"samples", "", 0, 1}, {"history", "", 0, 1},
    {"cube", "", 0, 0},          {"1d", "", 0, 0},       {"2d", "", 0, 0},      {"3d", "", 0, 0},
    {"persistent", "", 0, 0},    {"readback", "", 0, 0}, {"output", "", 0, 0},  {"no", "alias", 0, 0},
    {"layout", "general", 0, 0},
};

void parse_init(Parser& parser, ast::ResourceDeclaration& resource) {
  const Span span = parser.here();
  parser.take();
  if (resource.has_init) parser.complain({DiagnosticKind::RepeatedSetting, span, {"init"}});
  resource.has_init = true;
  parser.expect_one_of("`clear`", {"clear"});
  if (!parser.silent) resource.clear = parse_expression(parser, "a clear value");
}

// Back-to-front words after `ready`, `written`, `after`.
bool parse_boundary(Parser& parser, ast::ResourceDeclaration& resource) {
  if (parser.is_word("ready") || parser.is_word("written")) {
    resource.wrote = parser.is_word("written");
    parser.take();
    if (parser.expect_one_of("`as`", {"as"}).empty()) return true;
    resource.ready = parse_usage(parser);
    return true;
  }
  if (!parser.is_word("after")) return false;
  parser.take();
  parser.accept_word("as");
  resource.after = parse_usage(parser);
  return true;
}

bool parse_resource_setting(Parser& parser, ast::ResourceDeclaration& resource) {
  if (!parser.is(TokenKind::identifier) || parser.is(TokenKind::colon, 1)) return false;
  for (const SettingShape& shape : kResourceSettings) {
    if (!parser.is_word(shape.word) || (!shape.second.empty() && !parser.is_word(shape.second, 1))) continue;
    resource.settings.push_back(parse_setting(parser, shape));
    return true;
  }
  if (parser.is_word("allow")) return !parser.peek().starts_line && (parse_allow(parser), true);
  if (parser.is_word("init")) return parse_init(parser, resource), true;
  return parse_boundary(parser, resource);
}

void complain_about_setting(Parser& parser) {
  for (const SettingShape& shape : kResourceSettings)
    if (!shape.second.empty() && parser.is_word(shape.word)) {
      parser.take();
      return parser.expected("`" + std::string(shape.second) + "`");
    }
  std::vector<std::string_view> words = {"init", "ready", "written", "after"};
  for (const SettingShape& shape : kResourceSettings) words.push_back(shape.word);
  Diagnostic diagnostic(DiagnosticKind::UnknownSetting, parser.here(), {std::string(parser.word().substr(0, 40)), "a resource"});
  const Guess guess = closest(parser.word(), words);
  suggest(diagnostic, parser.here(), guess);
  parser.complain(std::move(diagnostic));
}

void parse_resource_settings(Parser& parser, ast::ResourceDeclaration& resource) {
  while (!parser.silent && parse_resource_setting(parser, resource)) continue;
  if (parser.silent || parser.peek().starts_line) return;
  const bool next_member = parser.is(TokenKind::identifier) && parser.is(TokenKind::colon, 1);
  const bool next_item = parser.is(TokenKind::identifier) && begins_item(parser.word());
  if (next_member || next_item) return;
  if (parser.is(TokenKind::identifier)) return complain_about_setting(parser);
}

void parse_buffer_type(Parser& parser, ast::ResourceDeclaration& buffer) {
  buffer.is_buffer = true;
  buffer.element = parse_type(parser);
}

ast::ResourceDeclaration finish(Parser& parser, ast::ResourceDeclaration resource) {
  if (!parser.silent) parse_resource_settings(parser, resource);
  resource.has_error = parser.silent;
  resource.span = resource.name.span;
  return resource;
}

}  // namespace

ast::ResourceDeclaration parse_image_type(Parser& parser, ast::ResourceDeclaration image) {
  image.format = parser.expect_name("a format");
  if (!parser.silent) image.size = parse_size(parser);
  return finish(parser, std::move(image));
}

namespace {

// The comma after the last stage parts parameters or members: `surface s: rgba8 view after storage in compute, params p: P`.
bool ends_stages(const Parser& parser) {
  if (!parser.is(TokenKind::comma) || !parser.is(TokenKind::identifier, 1)) return true;
  constexpr std::string_view kParameters[] = {"params", "surface", "in", "out", "inout", "image", "buffer", "const"};
  const bool parameter = std::find(std::begin(kParameters), std::end(kParameters), text_of(parser.peek(1), parser.text)) != std::end(kParameters);
  return parameter || parser.is(TokenKind::colon, 2);
}

}  // namespace

std::vector<ast::Name> parse_stages(Parser& parser) {
  std::vector<ast::Name> stages;
  do {
    stages.push_back(parser.expect_name("a stage"));
  } while (!parser.silent && !ends_stages(parser) && parser.accept(TokenKind::comma));
  return stages;
}

ast::Usage parse_usage(Parser& parser) {
  ast::Usage usage;
  const uint32_t begin = parser.peek().begin;
  usage.role = parser.expect_name("a role");
  if (!parser.silent && parser.accept(TokenKind::left_paren)) {
    usage.sampler = parse_place(parser, "a sampler");
    parser.expect(TokenKind::right_paren);
  }
  if (!parser.silent && parser.accept_word("in")) usage.stages = parse_stages(parser);
  usage.span = parser.since(begin);
  return usage;
}

ast::ResourceDeclaration parse_resource(Parser& parser) {
  const AllowScope scope(parser);
  ast::ResourceDeclaration resource;
  resource.is_buffer = parser.is_word("buffer");
  parser.take();
  resource.name = parser.expect_name(resource.is_buffer ? "the name of the buffer" : "the name of the image");
  parser.lost_names |= resource.name.empty();
  resource.index = parse_indices(parser);
  const bool colon = parser.expect(TokenKind::colon);
  if (!colon && parser.is(TokenKind::colon, 1) && !parser.peek(1).starts_line) parser.at += 2, parser.lost_names = true;  // one word too many
  if (!colon && !parser.is(TokenKind::identifier)) return finish(parser, std::move(resource));
  const bool missing_colon = parser.silent;
  parser.silent = false;
  if (!resource.is_buffer) {
    resource = parse_image_type(parser, std::move(resource));
  } else {
    parse_buffer_type(parser, resource);
    resource = finish(parser, std::move(resource));
  }
  parser.silent |= missing_colon && parser.silent;
  resource.has_error |= missing_colon;
  return resource;
}

ast::ResourceDeclaration parse_member(Parser& parser) {
  const AllowScope scope(parser);
  ast::ResourceDeclaration member;
  member.name = parser.expect_name("a member");
  parser.expect(TokenKind::colon);
  const ast::Name kind = parser.expect_one_of("`buffer` or `image`", {"buffer", "image"});
  if (parser.silent) return finish(parser, std::move(member));
  if (kind.text == "image") return parse_image_type(parser, std::move(member));
  parse_buffer_type(parser, member);
  return finish(parser, std::move(member));
}

}  // namespace rg::dsl
