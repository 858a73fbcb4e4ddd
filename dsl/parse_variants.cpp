// What chooses between variants: features and their terms, `features` and `spectrum` of a pass, `spectrum` declarations, `fuse`.
#include "dsl/parser_state.h"

namespace rg::dsl {
namespace {

void parse_names(Parser& parser, const char* what, std::vector<ast::Name>& names) {
  do {
    names.push_back(parser.expect_name(what));
  } while (!parser.silent && parser.accept(TokenKind::comma));
}

void parse_profile(Parser& parser, ast::SpectrumDeclaration& spectrum) {
  parser.take();
  spectrum.profile_span = parser.here();
  if (!parser.is(TokenKind::string)) return parser.expected("the path of a profile");
  spectrum.profile = parser.word().substr(1);
  if (!spectrum.profile.empty() && spectrum.profile.back() == '"') spectrum.profile.remove_suffix(1);
  parser.take();
}

void parse_member(Parser& parser, ast::SpectrumDeclaration& spectrum) {
  ast::SpectrumDeclaration::Member member;
  member.name = parser.expect_name("a feature, `modes` or `profile`");
  if (!parser.silent && parser.accept_word("requires")) parse_names(parser, "the name of a feature", member.needs);
  if (!parser.silent) spectrum.members.push_back(std::move(member));
}

}  // namespace

ast::Fuse parse_fuse(Parser& parser) {
  ast::Fuse fuse;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  fuse.name = parser.expect_name("the name of the kernel");
  if (!parser.silent) fuse.may = parser.accept_word("may");
  if (!parser.silent) fuse.unrounded = parser.accept_word("unrounded");
  if (!parser.silent && parser.accept_word("when")) fuse.term = parse_feature_term(parser);
  fuse.span = parser.since(begin);
  parse_items(parser, fuse.body);
  return fuse;
}

ast::FeaturesStatement parse_features(Parser& parser) {
  ast::FeaturesStatement statement;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  parse_names(parser, "the name of a feature", statement.names);
  statement.span = parser.since(begin);
  complain_about_rest(parser, {});
  return statement;
}

ast::SpectrumStatement parse_spectrum_statement(Parser& parser) {
  ast::SpectrumStatement statement;
  const uint32_t begin = parser.peek().begin;
  parser.take();
  statement.spectrum = parser.expect_name("the name of a spectrum");
  if (!parser.silent) parser.expect_one_of("`by`", {"by"});
  if (!parser.silent) statement.masks = parse_place(parser, "a buffer of masks");
  if (!parser.silent && parser.accept_word("into")) statement.kernels = parse_place(parser, "an image of kernels");
  statement.span = parser.since(begin);
  complain_about_rest(parser, {"by", "into"}, begin);
  return statement;
}

ast::SpectrumDeclaration parse_spectrum(Parser& parser) {
  ast::SpectrumDeclaration spectrum;
  parser.take();
  spectrum.name = parser.expect_name("the name of the spectrum");
  if (parser.silent) return spectrum;
  parse_block(parser, Level::fields, [&] {
    if (parser.accept_word("modes"))
      spectrum.modes = parse_expression(parser, "a number of kernels");
    else if (parser.is_word("profile"))
      parse_profile(parser, spectrum);
    else
      parse_member(parser, spectrum);
  });
  return spectrum;
}

ast::FeatureTerm parse_feature_term(Parser& parser) {
  ast::FeatureTerm term;
  const uint32_t begin = parser.peek().begin;
  term.negated = parser.is(TokenKind::identifier, 1) && !parser.peek(1).starts_line && parser.accept_word("not");
  if (parser.is(TokenKind::bang))
    parser.complain(Diagnostic(DiagnosticKind::UnexpectedToken, parser.here(), {"`not`", "`!`"}).fix(parser.here(), "not "));
  term.feature = parser.expect_name("a feature");
  if (!parser.silent && (parser.is(TokenKind::equal_equal) || parser.is(TokenKind::not_equal))) {
    term.negated ^= parser.is(TokenKind::not_equal);
    parser.take();
    term.value = parser.expect_name("a value of the feature");
  }
  term.span = parser.since(begin);
  return term;
}

namespace {

// `requires a and b == low`, `excludes c or d`, any number of them
void parse_feature_rules(Parser& parser, const ast::Name& value, ast::FeatureDeclaration& feature) {
  while (!parser.silent && (parser.is_word("requires") || parser.is_word("excludes"))) {
    const bool excludes = parser.is_word("excludes");
    parser.take();
    do {
      feature.rules.push_back({value, parse_feature_term(parser), excludes});
    } while (!parser.silent && parser.accept_word(excludes ? "or" : "and"));
  }
}

}  // namespace

ast::FeatureDeclaration parse_feature(Parser& parser) {
  ast::FeatureDeclaration feature;
  parser.take();
  feature.name = parser.expect_name("the name of the feature");
  parser.expect(TokenKind::colon);
  if (!parser.silent && parser.accept_word("bool")) return parse_feature_rules(parser, {}, feature), feature;
  if (!parser.silent && parser.accept_word("device")) {
    feature.capability = parser.expect_name("what a device can do");
    return parse_feature_rules(parser, {}, feature), feature;
  }
  feature.is_bool = false;
  const Span open = parser.here();
  if (parser.silent || !parser.expect(TokenKind::left_brace)) return feature;
  do {
    feature.values.push_back(parser.expect_name("a value"));
    parse_feature_rules(parser, feature.values.back(), feature);
  } while (!parser.silent && parser.accept(TokenKind::comma));
  if (!parser.silent) close_block(parser, open);
  return feature;
}

}  // namespace rg::dsl
