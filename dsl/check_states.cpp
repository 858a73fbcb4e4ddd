// Samplers, states, features, conditions, sets of the engine.
#include <fmt/format.h>

#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/features.h"

namespace rg::dsl {
namespace {

template <class Enum>
struct Word {
  std::string_view word;
  Enum value;
};

constexpr Word<Compare> kCompares[] = {{"never", Compare::never},
                                       {"less", Compare::less},
                                       {"equal", Compare::equal},
                                       {"less_equal", Compare::less_equal},
                                       {"greater", Compare::greater},
                                       {"not_equal", Compare::not_equal},
                                       {"greater_equal", Compare::greater_equal},
                                       {"always", Compare::always}};
constexpr Word<Filter> kFilters[] = {{"nearest", Filter::nearest}, {"linear", Filter::linear}};
constexpr Word<AddressMode> kAddresses[] = {
    {"repeat", AddressMode::repeat}, {"mirror", AddressMode::mirror}, {"clamp", AddressMode::clamp}, {"border", AddressMode::border}};
constexpr Word<Cull> kCulls[] = {{"none", Cull::none}, {"front", Cull::front}, {"back", Cull::back}};
constexpr Word<bool> kFronts[] = {{"clockwise", true}, {"counter_clockwise", false}};
constexpr Word<bool> kSwitches[] = {{"on", true}, {"off", false}};
constexpr Word<Topology> kTopologies[] = {
    {"points", Topology::points}, {"lines", Topology::lines}, {"triangles", Topology::triangles}, {"triangle_strip", Topology::triangle_strip}};

constexpr Word<StencilOp> kStencilOps[] = {{"keep", StencilOp::keep},
                                           {"zero", StencilOp::zero},
                                           {"replace", StencilOp::replace},
                                           {"increment", StencilOp::increment},
                                           {"decrement", StencilOp::decrement},
                                           {"invert", StencilOp::invert},
                                           {"increment_wrap", StencilOp::increment_wrap},
                                           {"decrement_wrap", StencilOp::decrement_wrap}};

// The value of a setting's word; reports a word that is none of `words`.
template <class Enum, size_t Count>
bool read_word(Checker& checker, const ast::Setting& setting, const Word<Enum> (&words)[Count], Enum& out) {
  if (setting.names.empty() || setting.names[0].empty()) return false;
  const ast::Name& name = setting.names[0];
  std::vector<std::string_view> candidates;
  std::string listed;
  for (const Word<Enum>& row : words) {
    if (row.word == name.text) return out = row.value, true;
    candidates.push_back(row.word);
    listed += (listed.empty() ? "`" : ", `") + std::string(row.word) + "`";
  }
  Diagnostic diagnostic(DiagnosticKind::UnknownSettingValue, name.span, {std::string(name.text), std::string(setting.word.text), listed});
  const Guess guess = closest(name.text, candidates);
  suggest(diagnostic, name.span, guess);
  checker.diagnostics.report(std::move(diagnostic));
  return false;
}

std::string title(const ast::Setting& setting) {
  return std::string(setting.word.text) + (setting.second.empty() ? "" : " " + std::string(setting.second.text));
}

void report_repeated(Checker& checker, const std::vector<ast::Setting>& settings) {
  for (size_t i = 0; i < settings.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      if (title(settings[i]) != title(settings[j])) continue;
      checker.report(DiagnosticKind::RepeatedSetting, settings[i].span, {title(settings[i])}).note(DiagnosticKind::FirstIsHere, settings[j].span);
      break;
    }
}

void read_sampler_setting(Checker& checker, uint32_t module, const ast::Setting& setting, Sampler& sampler) {
  const std::string_view word = setting.word.text;
  if (word == "filter") read_word(checker, setting, kFilters, sampler.filter);
  if (word == "mip") read_word(checker, setting, kFilters, sampler.mip_filter);
  if (word == "address") read_word(checker, setting, kAddresses, sampler.address);
  Compare compare{};
  if (word == "compare" && read_word(checker, setting, kCompares, compare)) sampler.compare = compare;
  if (word != "anisotropy" || setting.values.empty()) return;
  const auto value = evaluate_number(checker, nullptr, module, setting.values[0]);
  if (!value) return;
  if (*value < 1 || *value > 16)
    checker.report(DiagnosticKind::OutOfRange, setting.values[0].span, {std::to_string(static_cast<int64_t>(*value)), "1", "16"});
  sampler.max_anisotropy = static_cast<float>(*value);
}

void read_bias(Checker& checker, uint32_t module, const ast::Setting& setting, State& state) {
  if (setting.values.size() != 2) return;
  const auto constant = evaluate_number(checker, nullptr, module, setting.values[0]);
  const auto slope = evaluate_number(checker, nullptr, module, setting.values[1]);
  state.depth_bias_constant = static_cast<float>(constant.value_or(0));
  state.depth_bias_slope = static_cast<float>(slope.value_or(0));
}

// A number from 0 to 1; reports others.
std::optional<double> find_share(Checker& checker, uint32_t module, const ast::Expr& expr) {
  const auto value = evaluate_number(checker, nullptr, module, expr);
  if (!value || (*value >= 0 && *value <= 1)) return value;
  checker.report(DiagnosticKind::OutOfRange, expr.span, {fmt::format("{}", *value), "0", "1"});
  return std::nullopt;
}

float read_share(Checker& checker, uint32_t module, const ast::Expr& expr) {
  return static_cast<float>(find_share(checker, module, expr).value_or(0));
}

void read_bounds(Checker& checker, uint32_t module, const ast::Setting& setting, State& state) {
  if (setting.values.size() != 2) return;
  state.depth_bounds = true;
  const auto least = find_share(checker, module, setting.values[0]), greatest = find_share(checker, module, setting.values[1]);
  if (!least || !greatest) return;
  state.depth_min = static_cast<float>(*least);
  state.depth_max = static_cast<float>(*greatest);
  if (*greatest < *least)
    checker.report(DiagnosticKind::OutOfRange, setting.values[1].span, {fmt::format("{}", *greatest), fmt::format("{}", *least), "1"});
}

void read_sample_locations(Checker& checker, uint32_t module, const ast::Setting& setting, State& state) {
  for (size_t i = 0; i + 1 < setting.values.size(); i += 2)
    state.sample_locations.push_back({read_share(checker, module, setting.values[i]), read_share(checker, module, setting.values[i + 1])});
}

void read_stencil_setting(Checker& checker, uint32_t module, const ast::Setting& setting, StencilFace& face) {
  const std::string_view word = setting.second.text;
  if (word == "test") read_word(checker, setting, kCompares, face.compare);
  if (word == "fail") read_word(checker, setting, kStencilOps, face.fail);
  if (word == "depth_fail") read_word(checker, setting, kStencilOps, face.depth_fail);
  if (word == "pass") read_word(checker, setting, kStencilOps, face.pass);
  if (setting.values.empty()) return;
  const auto value = evaluate_integer(checker, nullptr, module, setting.values[0], 0, 255);
  if (!value) return;
  uint8_t& number = word == "reference" ? face.reference : word == "read_mask" ? face.read_mask : face.write_mask;
  number = static_cast<uint8_t>(*value);
}

// What is said of both faces holds where nothing is said of one.
void read_stencil(Checker& checker, uint32_t module, const std::vector<ast::Setting>& settings, State& state) {
  const auto each = [&](std::string_view word, StencilFace& face) {
    for (const ast::Setting& setting : settings)
      if (setting.word.text == word) read_stencil_setting(checker, module, setting, face), state.stencil_test = true;
  };
  each("stencil", state.stencil_front);
  state.stencil_back = state.stencil_front;
  each("stencil_front", state.stencil_front);
  each("stencil_back", state.stencil_back);
}

void read_state_setting(Checker& checker, uint32_t module, const ast::Setting& setting, State& state) {
  const std::string_view word = setting.word.text;
  if (word == "cull") read_word(checker, setting, kCulls, state.cull);
  if (word == "front") read_word(checker, setting, kFronts, state.front_clockwise);
  if (word == "topology") read_word(checker, setting, kTopologies, state.topology);
  if (word == "bias") read_bias(checker, module, setting, state);
  if (word == "alpha_to_coverage") state.alpha_to_coverage = true;
  if (word == "conservative") state.conservative = true;
  if (word == "samples") read_sample_locations(checker, module, setting, state);
  if (word == "depth" && setting.second.text == "bounds") read_bounds(checker, module, setting, state);
  if (word == "depth" && setting.second.text == "write") read_word(checker, setting, kSwitches, state.depth_write);
  if (word == "depth" && setting.second.text == "test") state.depth_test = read_word(checker, setting, kCompares, state.depth_compare);
}

// True for the first visit; the caller fills the row.
bool first_visit(Symbol& symbol) {
  if (symbol.progress != Symbol::Progress::open) return false;
  symbol.progress = Symbol::Progress::done;
  return true;
}

void read_capability(Checker& checker, const ast::Name& name, Feature& feature) {
  static const std::vector<std::string_view> kNames = {
#define RG_CAPABILITY(name, meaning) #name,
#include "dsl/capability.def"
#undef RG_CAPABILITY
  };
  const auto found = std::find(kNames.begin(), kNames.end(), name.text);
  if (found != kNames.end()) return void(feature.capability = static_cast<Capability>(found - kNames.begin() + 1));
  Diagnostic diagnostic(DiagnosticKind::UnknownName, name.span, {"capability of devices", std::string(name.text)});
  const Guess guess = closest(name.text, kNames);
  suggest(diagnostic, name.span, guess);
  checker.diagnostics.report(std::move(diagnostic));
}

void read_feature(Checker& checker, const ast::FeatureDeclaration& node, Feature& feature) {
  if (node.is_bool) feature.values = {"off", "on"};
  if (!node.capability.empty()) read_capability(checker, node.capability, feature);
  for (size_t i = 0; i < node.values.size(); ++i) {
    const ast::Name& value = node.values[i];
    for (size_t j = 0; j < i; ++j)
      if (node.values[j].text == value.text) report_duplicate(checker, value, node.values[j].span);
    feature.values.emplace_back(value.text);
  }
}

bool is_bool(const Feature& feature) { return feature.values.size() == 2 && feature.values[0] == "off" && feature.values[1] == "on"; }

std::optional<uint32_t> value_index(Checker& checker, const ast::FeatureTerm& term, const Feature& feature) {
  if (term.value.empty() && is_bool(feature)) return 1;
  if (term.value.empty()) {
    checker.report(DiagnosticKind::FeatureNeedsValue, term.feature.span, {feature.name})
        .note(DiagnosticKind::DeclaredHere, feature.span, {feature.name});
    return std::nullopt;
  }
  const auto found = std::find(feature.values.begin(), feature.values.end(), term.value.text);
  if (found != feature.values.end()) return static_cast<uint32_t>(found - feature.values.begin());
  const std::vector<std::string_view> candidates(feature.values.begin(), feature.values.end());
  Diagnostic diagnostic(DiagnosticKind::UnknownName, term.value.span, {"value of feature `" + feature.name + "`", std::string(term.value.text)});
  const bool truth = is_bool(feature) && (term.value.text == "true" || term.value.text == "false");
  const Guess guess = truth ? Guess{{term.value.text == "true" ? "on" : "off"}, true} : closest(term.value.text, candidates);
  suggest(diagnostic, term.value.span, guess);
  diagnostic.note(DiagnosticKind::DeclaredHere, feature.span, {feature.name});
  checker.diagnostics.report(std::move(diagnostic));
  return std::nullopt;
}

uint32_t value_with_rule(const ast::FeatureDeclaration& node, const ast::FeatureRule& rule) {
  if (node.is_bool) return 1;
  const auto same = [&](const ast::Name& value) { return value.text == rule.value.text; };
  return static_cast<uint32_t>(std::find_if(node.values.begin(), node.values.end(), same) - node.values.begin());
}

void read_rules(Checker& checker, uint32_t symbol) {
  const auto& node = std::get<ast::FeatureDeclaration>(*checker.symbols[symbol].declaration);
  const FeatureId id = feature_of(checker, symbol);
  for (const ast::FeatureRule& rule : node.rules) {
    const auto term = feature_term(checker, checker.symbols[symbol].module, rule.term);
    if (!term) continue;
    const Feature::Rule row{value_with_rule(node, rule), rule.excludes ? opposite(checker, *term) : *term, rule.term.span};
    checker.program.features[id].rules.push_back(row);
  }
}

// The rule that leaves `value` no room, as far as one alone does.
Span culprit(const Feature& feature, uint32_t value) {
  for (const Feature::Rule& rule : feature.rules)
    if (rule.value == value) return rule.span;
  return feature.span;
}

// A value that no choice of the other features allows is a mistake in the rules.
void check_values_possible(Checker& checker, FeatureId id) {
  constexpr uint64_t kBudget = 4096;
  const Feature& feature = checker.program.features[id];
  for (uint32_t value = 0; value < feature.values.size(); ++value) {
    FeatureValues decided(checker.program.features.size(), kFreeFeature);
    decided[id.value] = value;
    const std::vector<bool> none(decided.size(), false);
    bool possible = false;
    const bool finished = each_configuration(checker.program.features, decided, none, kBudget, [&](const FeatureValues&) { return possible = true; });
    if (possible || !finished) continue;
    Diagnostic& impossible = checker.report(DiagnosticKind::ValueImpossible, culprit(feature, value), {feature.name, feature.values[value]})
                                 .note(DiagnosticKind::DeclaredHere, feature.span, {feature.name});
    for (const Feature& other : checker.program.features)
      for (const Feature::Rule& rule : other.rules)
        if (rule.needs.feature == id) impossible.note(DiagnosticKind::AccessUsedHere, rule.span, {feature.name});
    return;
  }
}

// A row each, in order: a condition is a bit of a word that the host fills once a frame.
void add_conditions(Checker& checker, uint32_t symbol) {
  constexpr uint32_t kMaxConditions = 64;
  const auto& node = std::get<ast::ConditionDeclaration>(*checker.symbols[symbol].declaration);
  const std::string name(node.name.text);
  auto& rows = checker.program.conditions;
  int64_t count = 1;
  if (node.count) count = evaluate_integer(checker, nullptr, checker.symbols[symbol].module, *node.count, 1, kMaxConditions).value_or(0);
  if (count == 0) return;
  if (rows.size() + static_cast<size_t>(count) > kMaxConditions) {
    checker.report(DiagnosticKind::TooManyConditions, node.name.span, {name, std::to_string(kMaxConditions + 1), std::to_string(kMaxConditions)});
    return;
  }
  checker.symbols[symbol].id = static_cast<uint32_t>(rows.size());
  if (!node.count) return void(rows.add({name, node.name.span}));
  for (uint32_t i = 0; i < count; ++i) rows.add({name + "[" + std::to_string(i) + "]", node.name.span, name, i, static_cast<uint32_t>(count)});
}

}  // namespace

std::optional<Guard::Term> feature_term(Checker& checker, uint32_t module, const ast::FeatureTerm& term) {
  const auto symbol = find_symbol(checker, module, term.feature, SymbolKind::feature);
  if (!symbol) return std::nullopt;
  const FeatureId id = feature_of(checker, *symbol);
  const auto value = value_index(checker, term, checker.program.features[id]);
  if (!value) return std::nullopt;
  const Guard::Term plain{id, *value, false};
  return term.negated ? opposite(checker, plain) : plain;
}

Guard::Term opposite(const Checker& checker, Guard::Term term) {
  if (checker.program.features[term.feature].values.size() == 2) return {term.feature, 1 - term.value, term.negated};  // the other value
  term.negated = !term.negated;
  return term;
}

bool is_reachable(const Checker& checker, const Guard& guard) {
  constexpr uint64_t kBudget = 4096;
  std::vector<bool> open(checker.program.features.size(), false);
  for (const Guard::Term& term : guard.terms) open[term.feature.value] = true;
  bool reached = false;
  const FeatureValues free(open.size(), kFreeFeature);
  const bool finished = each_configuration(checker.program.features, free, open, kBudget,
                                           [&](const FeatureValues& values) { return !(reached = holds(guard, values)); });
  return reached || !finished;
}

void check_features(Checker& checker) {
  for (uint32_t symbol = 0; symbol < checker.symbols.size(); ++symbol)
    if (checker.symbols[symbol].kind == SymbolKind::feature) read_rules(checker, symbol);
  for (size_t id = 0; id < checker.program.features.size(); ++id)
    if (!checker.program.features.rows[id].rules.empty()) check_values_possible(checker, FeatureId{id});
}

SamplerId sampler_of(Checker& checker, uint32_t symbol) {
  if (first_visit(checker.symbols[symbol])) {
    const Symbol& found = checker.symbols[symbol];
    const auto& node = std::get<ast::SamplerDeclaration>(*found.declaration);
    Sampler sampler;
    sampler.name = std::string(node.name.text);
    sampler.span = node.name.span;
    report_repeated(checker, node.settings);
    for (const ast::Setting& setting : node.settings) read_sampler_setting(checker, found.module, setting, sampler);
    checker.symbols[symbol].id = checker.program.samplers.add(std::move(sampler)).value;
  }
  return SamplerId{size_t{checker.symbols[symbol].id}};
}

StateId state_of(Checker& checker, uint32_t symbol) {
  if (first_visit(checker.symbols[symbol])) {
    const Symbol& found = checker.symbols[symbol];
    const auto& node = std::get<ast::StateDeclaration>(*found.declaration);
    State state;
    state.name = std::string(node.name.text);
    state.span = node.name.span;
    report_repeated(checker, node.settings);
    for (const ast::Setting& setting : node.settings) read_state_setting(checker, found.module, setting, state);
    read_stencil(checker, found.module, node.settings, state);
    checker.symbols[symbol].id = checker.program.states.add(std::move(state)).value;
  }
  return StateId{size_t{checker.symbols[symbol].id}};
}

FeatureId feature_of(Checker& checker, uint32_t symbol) {
  if (first_visit(checker.symbols[symbol])) {
    const auto& node = std::get<ast::FeatureDeclaration>(*checker.symbols[symbol].declaration);
    Feature feature;
    feature.name = std::string(node.name.text);
    feature.span = node.name.span;
    read_feature(checker, node, feature);
    checker.symbols[symbol].id = checker.program.features.add(std::move(feature)).value;
  }
  return FeatureId{size_t{checker.symbols[symbol].id}};
}

ConditionId condition_of(Checker& checker, uint32_t symbol) {
  if (first_visit(checker.symbols[symbol])) add_conditions(checker, symbol);
  const uint32_t id = checker.symbols[symbol].id;
  return id == UINT32_MAX ? ConditionId{} : ConditionId{size_t{id}};
}

void check_engine_set(Checker& checker, uint32_t symbol) {
  const auto& node = std::get<ast::EngineSetDeclaration>(*checker.symbols[symbol].declaration);
  if (node.set != 0 && node.set != 2) {
    checker.report(DiagnosticKind::EngineSetNumber, node.set_span, {std::string(node.name.text)});
    return;
  }
  checker.program.engine_sets.add({std::string(node.name.text), static_cast<uint32_t>(node.set), std::string(node.glsl), node.name.span});
}

}  // namespace rg::dsl
