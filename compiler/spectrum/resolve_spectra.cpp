#include "compiler/spectrum/resolve_spectra.h"

#include <algorithm>

#include "compiler/shaders/cache.h"
#include "compiler/shaders/statistics.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;

struct User {  // a pass with a spectrum
  dsl::GraphId graph;
  const dsl::Pass* pass = nullptr;
};

std::vector<User> users_of(const dsl::Program& program, dsl::SpectrumId spectrum) {
  std::vector<User> users;
  for (size_t g = 0; g < program.graphs.size(); ++g)
    for (const dsl::Pass& pass : program.graphs.rows[g].passes)
      if (pass.spectrum == spectrum) users.push_back({dsl::GraphId{g}, &pass});
  return users;
}

int64_t groups(const dsl::Program& program, const dsl::Dispatch& dispatch, const std::vector<int64_t>& extents) {
  int64_t product = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int64_t size = dispatch.size[axis].valid() ? dsl::evaluate(program, dispatch.size[axis], extents) : 1;
    product *= dispatch.kind == dsl::DispatchKind::groups ? size : (size + dispatch.group[axis] - 1) / dispatch.group[axis];
  }
  return product;
}

bool check_grid(const dsl::Program& program, const User& user, dsl::Diagnostics& diagnostics) {
  const dsl::Resource& masks = program.graphs[user.graph].resources[user.pass->accesses[user.pass->masks].resource];
  for (const auto& extents : {dsl::initial_extents(program), dsl::maximum_extents(program)}) {
    const int64_t count = masks.count.valid() ? dsl::evaluate(program, masks.count, extents) : 0;
    const int64_t grid = groups(program, user.pass->dispatch, extents);
    if (!masks.count.valid() || count == grid) continue;
    diagnostics.report(DiagnosticKind::SpectrumGrid, user.pass->span, {masks.name, std::to_string(count), user.pass->name, std::to_string(grid)});
    return false;
  }
  return true;
}

std::optional<SpectrumProfile> find_profile(const dsl::Spectrum& spectrum, const ReadFile& read, const ReadFile& read_override,
                                            const SpectrumOptions& options, dsl::Diagnostics& diagnostics) {
  const bool replaced = !options.profile.empty();
  const std::string& path = replaced ? options.profile : spectrum.profile;
  const dsl::Span span = replaced ? dsl::Span{} : spectrum.profile_span;
  if (path.empty()) {
    diagnostics.report(DiagnosticKind::NoProfile, spectrum.span, {spectrum.name});
    return std::nullopt;
  }
  const auto text = replaced ? read_override(path) : read(path);
  if (!text) {
    diagnostics.report(DiagnosticKind::SpectrumProfileNotReadable, span, {path, "no such file, or no permission"});
    return std::nullopt;
  }
  ProfileResult result = read_profile(spectrum, *text);
  if (result.fault == ProfileFault::unreadable) diagnostics.report(DiagnosticKind::SpectrumProfileNotReadable, span, {path, result.why});
  if (result.fault == ProfileFault::foreign) diagnostics.report(DiagnosticKind::ProfileForeign, span, {path, spectrum.name, result.why});
  if (result.fault == ProfileFault::empty) diagnostics.report(DiagnosticKind::ProfileEmpty, span, {path});
  if (result.fault != ProfileFault::none) return std::nullopt;
  return std::move(result.profile);
}

// ---- costs

// Sampled and stored texels cost as much as several arithmetic instructions: latency hidden by other waves, bandwidth not.
double work_of(const ShaderStatistics& s) { return s.alu + 8.0 * s.samples + 4.0 * (s.loads + s.stores) + 8.0 * s.atomics; }

std::vector<Mask> sampled_sets(uint32_t features) {
  std::vector<Mask> sets = {0};
  for (uint32_t a = 0; a < features; ++a) {
    sets.push_back(Mask{1} << a);
    for (uint32_t b = 0; b < a; ++b) sets.push_back(Mask{1} << a | Mask{1} << b);
  }
  const Mask full = static_cast<Mask>((uint64_t{1} << features) - 1);
  if (std::find(sets.begin(), sets.end(), full) == sets.end()) sets.push_back(full);
  return sets;
}

// The kernels of these sets, as they will be built. Empty where the shader does not compile: that is reported when it is built.
std::vector<ShaderStatistics> measure_kernels(const dsl::Program& program, const User& user, const std::vector<Mask>& sets, const ReadFile& read,
                                              dsl::SourceFiles files, const SpectrumOptions& options) {
  const dsl::Program expanded = expand_spectra(program, {{user.pass->spectrum, sets}});
  const dsl::Graph& graph = expanded.graphs[user.graph];
  VariantSpace space;
  std::vector<size_t> kernels(sets.size(), SIZE_MAX);
  for (size_t p = 0; p < graph.passes.size(); ++p) {
    space.passes.emplace_back();
    for (size_t k = 0; k < sets.size(); ++k) {
      if (graph.passes.rows[p].name != kernel_name(user.pass->name, k)) continue;
      kernels[k] = p;
      VariantRow row;
      for (const dsl::ShaderFeature& feature : graph.passes.rows[p].features)
        row.values.push_back(feature.feature.valid() ? program.features[feature.feature].initial : feature.value);
      space.passes.back().push_back(std::move(row));
    }
  }
  dsl::Diagnostics ignored;
  const ShaderBundle bundle = compile_shaders(expanded, user.graph, space, read, files, {options.cache, options.workers, options.progress}, ignored);
  std::vector<ShaderStatistics> statistics;
  for (const size_t pass : kernels) {
    if (pass == SIZE_MAX || bundle.passes[pass].shaders.empty()) return {};
    statistics.push_back(find_statistics(bundle.shaders[bundle.passes[pass].shaders[0]].words));
  }
  return statistics;
}

CostModel model_of(const dsl::Program& program, const User& user, const std::optional<SpectrumProfile>& profile, const ReadFile& read,
                   const dsl::SourceFiles& files, const SpectrumOptions& options) {
  const auto features = static_cast<uint32_t>(program.spectra[user.pass->spectrum].members.size());
  CostModel model;
  model.work.features.assign(features, 0.1);
  if (profile && !profile->costs.empty()) {
    model.work = fit_least_squares(features, profile->costs);
    model.measured = profile->costs;
    return model;
  }
  const std::vector<Mask> sets = sampled_sets(features);
  const std::vector<ShaderStatistics> statistics = measure_kernels(program, user, sets, read, files, options);
  if (statistics.empty()) return model;
  std::vector<std::pair<Mask, double>> work, registers;
  for (size_t i = 0; i < sets.size(); ++i) {
    work.emplace_back(sets[i], work_of(statistics[i]));
    registers.emplace_back(sets[i], statistics[i].live_scalars);
  }
  model.work = fit_terms(features, work);
  model.registers = fit_terms(features, registers);
  return model;
}

SpectrumProblem make_problem(const dsl::Spectrum& spectrum, const std::optional<SpectrumProfile>& profile, CostModel costs,
                             const SpectrumOptions& options) {
  SpectrumProblem problem;
  problem.features = static_cast<uint32_t>(spectrum.members.size());
  for (const dsl::Spectrum::Member& member : spectrum.members) {
    problem.needs.push_back(0);
    for (const uint32_t need : member.needs) problem.needs.back() |= Mask{1} << need;
  }
  problem.histogram = profile ? profile->histogram : assumed_profile(spectrum).histogram;
  for (MaskWeight& row : problem.histogram) row.mask |= options.force;
  problem.costs = std::move(costs);
  problem.modes = options.modes.value_or(spectrum.modes);
  return problem;
}

}  // namespace

std::vector<SpectrumChoice> resolve_spectra(const dsl::Program& program, const ReadFile& read, const ReadFile& read_override, dsl::SourceFiles& files,
                                            const SpectrumOptions& options, dsl::Diagnostics& diagnostics) {
  std::vector<SpectrumChoice> choices;
  for (size_t s = 0; s < program.spectra.size(); ++s) {
    const std::vector<User> users = users_of(program, dsl::SpectrumId{s});
    if (users.empty()) continue;
    bool good = true;
    for (const User& user : users) good = check_grid(program, user, diagnostics) && good;
    const dsl::Spectrum& spectrum = program.spectra.rows[s];
    auto profile = find_profile(spectrum, read, read_override, options, diagnostics);
    if (!good || diagnostics.has_errors()) continue;
    CostModel model = model_of(program, users[0], profile, read, files, options);
    SpectrumProblem problem = make_problem(spectrum, profile, std::move(model), options);
    ModeChoice choice = choose_modes(problem);
    choices.push_back({dsl::SpectrumId{s}, users[0].pass->name, std::move(profile), std::move(problem), std::move(choice)});
  }
  return choices;
}

std::vector<KernelSets> kernel_sets(const std::vector<SpectrumChoice>& choices) {
  std::vector<KernelSets> sets;
  for (const SpectrumChoice& choice : choices) sets.push_back({choice.spectrum, choice.choice.modes});
  return sets;
}

std::vector<std::string> profile_paths(const dsl::Program& program) {
  std::vector<std::string> paths;
  for (const dsl::Spectrum& spectrum : program.spectra)
    if (!spectrum.profile.empty()) paths.push_back(spectrum.profile);
  return paths;
}

}  // namespace rg::compiler
