// Types and structs, and the settings of samplers and states.
#include "dsl/parser_state.h"

namespace rg::dsl {

ast::TypeName parse_type(Parser& parser) {
  ast::TypeName type;
  const uint32_t begin = parser.peek().begin;
  type.name.kind = ast::ExprKind::name;
  const ast::Name first = parser.expect_name("a type");
  type.name.text = first.text;
  type.name.span = first.span;
  if (first.empty()) type.name.kind = ast::ExprKind::error;
  if (parser.accept(TokenKind::dot)) {
    ast::Expr member;
    member.kind = ast::ExprKind::member;
    member.text = parser.expect_name("the name of a type").text;
    member.operands.push_back(std::move(type.name));
    member.span = parser.since(begin);
    type.name = std::move(member);
  }
  if (parser.accept(TokenKind::left_bracket)) {
    type.unsized = parser.accept(TokenKind::right_bracket);
    if (!type.unsized) {
      type.count = parse_expression(parser, "a length");
      parser.expect(TokenKind::right_bracket);
    }
  }
  type.span = parser.since(begin);
  return type;
}

ast::StructDeclaration parse_struct(Parser& parser) {
  ast::StructDeclaration record;
  record.name = parser.expect_name("the name of the struct");
  record.scalar = !parser.silent && parser.accept_word("scalar");
  parse_block(parser, Level::fields, [&] {
    ast::FieldDeclaration field;
    field.name = parser.expect_name("a field");
    parser.expect(TokenKind::colon);
    if (!parser.silent || parser.is(TokenKind::identifier)) field.type = parse_type(parser);
    parser.accept(TokenKind::comma);
    if (!parser.silent) record.fields.push_back(std::move(field));
  });
  return record;
}

ast::Setting parse_setting(Parser& parser, const SettingShape& shape) {
  ast::Setting setting;
  const uint32_t begin = parser.peek().begin;
  setting.word = parser.take_name();
  if (!shape.second.empty()) setting.second = parser.take_name();
  for (uint8_t i = 0; i < shape.names && !parser.silent; ++i) setting.names.push_back(parser.expect_name("a word"));
  do
    for (uint8_t i = 0; i < shape.values && !parser.silent; ++i) setting.values.push_back(parse_expression(parser, "a number"));
  while (shape.repeats && !parser.silent && parser.accept(TokenKind::comma));
  setting.span = parser.since(begin);
  return setting;
}

std::vector<ast::Setting> parse_settings(Parser& parser, std::initializer_list<SettingShape> shapes, const char* what) {
  std::vector<ast::Setting> settings;
  const auto fits = [&](const SettingShape& shape) {
    return parser.is_word(shape.word) && (shape.second.empty() || parser.is_word(shape.second, 1));
  };
  parse_block(parser, Level::fields, [&] {
    const auto* shape = std::find_if(shapes.begin(), shapes.end(), fits);
    if (shape != shapes.end()) {
      settings.push_back(parse_setting(parser, *shape));
      return;
    }
    std::vector<std::string_view> words;
    for (const SettingShape& known : shapes) words.push_back(known.word);
    Diagnostic diagnostic(DiagnosticKind::UnknownSetting, parser.here(), {std::string(parser.word().substr(0, 40)), what});
    const Guess guess = closest(parser.word(), words);
    suggest(diagnostic, parser.here(), guess);
    parser.complain(std::move(diagnostic));
  });
  return settings;
}

}  // namespace rg::dsl
