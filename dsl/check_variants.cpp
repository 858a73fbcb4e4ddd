// Features that reach shaders, and spectra: features that the GPU chooses by tile.
#include <algorithm>

#include "dsl/check_state.h"
#include "dsl/paths.h"

namespace rg::dsl {
namespace {

constexpr size_t kMaxMembers = 32;  // bits of a mask
constexpr int64_t kMaxModes = 32;

bool is_bool(const Feature& feature) { return feature.values.size() == 2 && feature.values[0] == "off" && feature.values[1] == "on"; }

void read_members(Checker& checker, const ast::SpectrumDeclaration& node, Spectrum& spectrum) {
  for (size_t i = 0; i < node.members.size(); ++i) {
    const ast::Name& name = node.members[i].name;
    for (size_t j = 0; j < i; ++j)
      if (node.members[j].name.text == name.text) report_duplicate(checker, name, node.members[j].name.span);
    spectrum.members.push_back({std::string(name.text), {}, name.span});
  }
}

void read_need(Checker& checker, const ast::Name& need, Spectrum& spectrum, size_t member) {
  std::vector<std::string_view> names;
  for (const Spectrum::Member& each : spectrum.members) names.push_back(each.name);
  const auto found = std::find(names.begin(), names.end(), need.text);
  if (found != names.end()) return spectrum.members[member].needs.push_back(static_cast<uint32_t>(found - names.begin()));
  Diagnostic diagnostic(DiagnosticKind::UnknownName, need.span, {"feature of spectrum `" + spectrum.name + "`", std::string(need.text)});
  const Guess guess = closest(need.text, names);
  suggest(diagnostic, need.span, guess);
  checker.diagnostics.report(std::move(diagnostic));
}

void read_profile(Checker& checker, uint32_t module, const ast::SpectrumDeclaration& node, Spectrum& spectrum) {
  spectrum.profile_span = node.profile_span;
  if (node.profile.empty()) return;
  const auto path = join_inside(checker.modules[module].folder, node.profile);
  if (path) spectrum.profile = *path;
  if (!path)
    checker.report(DiagnosticKind::SpectrumProfileNotReadable, node.profile_span,
                   {std::string(node.profile), "it is outside the folder of the root file"});
}

Spectrum read_spectrum(Checker& checker, uint32_t module, const ast::SpectrumDeclaration& node) {
  Spectrum spectrum;
  spectrum.name = std::string(node.name.text);
  spectrum.span = node.name.span;
  read_members(checker, node, spectrum);
  for (size_t i = 0; i < node.members.size(); ++i)
    for (const ast::Name& need : node.members[i].needs) read_need(checker, need, spectrum, i);
  if (spectrum.members.empty() || spectrum.members.size() > kMaxMembers)
    checker.report(DiagnosticKind::SpectrumSize, node.name.span,
                   {spectrum.name, std::to_string(spectrum.members.size()), std::to_string(kMaxMembers)});
  if (node.modes)
    if (const auto modes = evaluate_integer(checker, nullptr, module, *node.modes, 1, kMaxModes)) spectrum.modes = static_cast<uint32_t>(*modes);
  read_profile(checker, module, node, spectrum);
  return spectrum;
}

bool add_masks(Checker& checker, GraphScope& scope, PassScope& out, const ast::SpectrumStatement& statement) {
  const Place place = find_place(checker, scope, statement.masks);
  if (!place.ok()) return false;
  const Resource& masks = scope.graph.resources[place.resource];
  const bool fits = masks.kind == ResourceKind::buffer && masks.element == Type{Scalar::u32, 1, 1, {}, 0};
  if (!fits) {
    checker.report(DiagnosticKind::SpectrumMasks, statement.masks.span, {masks.name, std::string(statement.spectrum.text)});
    return false;
  }
  out.pass.masks = add_plain_access(scope, out, place, Mode::read, Role::storage);
  return true;
}

bool add_kernel_image(Checker& checker, GraphScope& scope, PassScope& out, const ast::SpectrumStatement& statement) {
  if (!statement.kernels) return true;
  const Place place = find_place(checker, scope, *statement.kernels);
  if (!place.ok()) return false;
  const Resource& image = scope.graph.resources[place.resource];
  if (image.kind != ResourceKind::image || image.format != Format::r32ui) {
    checker.report(DiagnosticKind::KernelImage, statement.kernels->span, {image.name, std::string(statement.spectrum.text)});
    return false;
  }
  out.pass.kernels = add_plain_access(scope, out, place, Mode::write, Role::storage);
  return true;
}

bool is_written_by_shader(const Access& access) { return is_shader_role(access.role) && is_written(access.mode); }

}  // namespace

SpectrumId spectrum_of(Checker& checker, uint32_t symbol) {
  if (checker.symbols[symbol].progress == Symbol::Progress::open) {
    checker.symbols[symbol].progress = Symbol::Progress::done;
    const uint32_t module = checker.symbols[symbol].module;
    Spectrum spectrum = read_spectrum(checker, module, std::get<ast::SpectrumDeclaration>(*checker.symbols[symbol].declaration));
    checker.symbols[symbol].id = checker.program.spectra.add(std::move(spectrum)).value;
  }
  return SpectrumId{size_t{checker.symbols[symbol].id}};
}

bool add_features(Checker& checker, const GraphScope& scope, Pass& pass, const ast::FeaturesStatement& statement) {
  if (pass.kind != PassKind::compute && pass.kind != PassKind::raster) {
    checker.report(DiagnosticKind::FeaturesWithoutShader, statement.span, {pass.name});
    return false;
  }
  bool good = true;
  for (const ast::Name& name : statement.names) {
    const auto symbol = find_symbol(checker, scope.module, name, SymbolKind::feature);
    good = good && symbol;
    if (!symbol) continue;
    const FeatureId id = feature_of(checker, *symbol);
    const Feature& feature = checker.program.features[id];
    const auto same = [&](const ShaderFeature& other) { return other.feature == id; };
    const auto repeated = std::find_if(pass.features.begin(), pass.features.end(), same);
    if (repeated != pass.features.end())
      report_duplicate(checker, name, repeated->span);
    else
      pass.features.push_back({feature.name, id, 0, is_bool(feature) ? std::vector<std::string>{} : feature.values, name.span});
  }
  return good;
}

bool add_spectrum(Checker& checker, GraphScope& scope, PassScope& out, const ast::SpectrumStatement& statement) {
  const auto symbol = find_symbol(checker, scope.module, statement.spectrum, SymbolKind::spectrum);
  if (!symbol) return false;
  if (out.pass.spectrum.valid()) {
    checker.report(DiagnosticKind::RepeatedWork, statement.span, {"spectrum"});
    return false;
  }
  out.pass.spectrum = spectrum_of(checker, *symbol);
  const bool masks = add_masks(checker, scope, out, statement);
  return add_kernel_image(checker, scope, out, statement) && masks;
}

bool check_spectrum_pass(Checker& checker, const Graph& graph, const Pass& pass) {
  if (!pass.spectrum.valid()) return true;
  const std::string& spectrum = checker.program.spectra[pass.spectrum].name;
  const bool dispatches = pass.dispatch.kind == DispatchKind::over || pass.dispatch.kind == DispatchKind::groups;
  if (pass.kind != PassKind::compute || pass.shaders.empty() || !dispatches) {
    checker.report(DiagnosticKind::SpectrumOfPass, pass.span, {pass.name, spectrum});
    return false;
  }
  bool good = true;
  for (const Access& access : pass.accesses) {
    const bool of_classifier = pass.kernels != kAll && &access == &pass.accesses[pass.kernels];
    if (of_classifier || !is_written_by_shader(access) || access.disjoint || access.mode == Mode::atomic) continue;
    checker.report(DiagnosticKind::SpectrumNotDisjoint, access.span, {spectrum, graph.resources[access.resource].name})
        .fix({access.span.file, access.span.end, access.span.end}, " disjoint");
    good = false;
  }
  return good;
}

}  // namespace rg::dsl
