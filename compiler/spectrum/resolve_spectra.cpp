#include "compiler/spectrum/resolve_spectra.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>

#include "compiler/shaders/cache.h"
#include "compiler/shaders/shader_jobs.h"
#include "compiler/shaders/statistics.h"
#include "compiler/spectrum/kept_choice.h"

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

using Grid = std::array<int64_t, 3>;
Grid groups(const dsl::Program& program, const dsl::Dispatch& dispatch, const std::vector<int64_t>& extents) {
  Grid grid = {1, 1, 1};
  for (size_t axis = 0; axis < 3; ++axis) {
    if (dispatch.size[axis].valid()) grid[axis] = dsl::evaluate(program, dispatch.size[axis], extents);
    if (dispatch.kind != dsl::DispatchKind::groups) grid[axis] = (grid[axis] + dispatch.group[axis] - 1) / dispatch.group[axis];
  }
  return grid;
}

const dsl::Resource& resource_of(const dsl::Program& program, const User& user, uint32_t access) {
  return program.graphs[user.graph].resources[user.pass->accesses[access].resource];
}
std::string text_of(const Grid& grid) {
  return std::to_string(grid[0]) + "x" + std::to_string(grid[1]) + (grid[2] == 1 ? "" : "x" + std::to_string(grid[2]));
}

// A kernel may have to shade all groups, and one dispatch runs them along one axis.
bool check_group_limit(const User& user, const Grid& grid, dsl::Diagnostics& diagnostics) {
  constexpr int64_t kMostGroups = 65535;  // what every device allows along an axis
  if (grid[2] == 1 && grid[0] * grid[1] <= kMostGroups) return true;
  diagnostics.report(DiagnosticKind::SpectrumGroups, user.pass->span, {user.pass->name, text_of(grid), std::to_string(kMostGroups)});
  return false;
}

bool check_masks(const dsl::Program& program, const User& user, const Grid& grid, const std::vector<int64_t>& extents,
                 dsl::Diagnostics& diagnostics) {
  const dsl::Resource& masks = resource_of(program, user, user.pass->masks);
  const int64_t count = masks.count.valid() ? dsl::evaluate(program, masks.count, extents) : 0, wanted = grid[0] * grid[1] * grid[2];
  if (!masks.count.valid() || count == wanted) return true;
  diagnostics.report(DiagnosticKind::SpectrumGrid, user.pass->span, {masks.name, std::to_string(count), user.pass->name, std::to_string(wanted)});
  return false;
}

bool check_kernel_image(const dsl::Program& program, const User& user, const Grid& grid, const std::vector<int64_t>& extents,
                        dsl::Diagnostics& diagnostics) {
  if (user.pass->kernels == dsl::kAll) return true;
  const dsl::Resource& image = resource_of(program, user, user.pass->kernels);
  Grid texels = {1, 1, 1};
  const dsl::ExprId sizes[] = {image.width, image.height, image.depth};
  for (size_t axis = 0; axis < 3; ++axis)
    if (sizes[axis].valid()) texels[axis] = dsl::evaluate(program, sizes[axis], extents);
  if (texels == grid) return true;
  diagnostics.report(DiagnosticKind::KernelImageGrid, user.pass->span, {image.name, text_of(texels), user.pass->name, text_of(grid)});
  return false;
}

bool check_grid(const dsl::Program& program, const User& user, dsl::Diagnostics& diagnostics) {
  for (const auto& extents : {dsl::initial_extents(program), dsl::maximum_extents(program)}) {
    const Grid grid = groups(program, user.pass->dispatch, extents);
    if (!check_group_limit(user, grid, diagnostics)) return false;
    if (!check_masks(program, user, grid, extents, diagnostics) || !check_kernel_image(program, user, grid, extents, diagnostics)) return false;
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
  std::string why;
  const auto text = replaced ? read_override(path, why) : read(path, why);
  if (!text) {
    diagnostics.report(DiagnosticKind::SpectrumProfileNotReadable, span, {path, why});
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

double cost_of(const Words& words) {
  const ShaderStatistics statistics = find_statistics(words);
  return work_of(statistics) * register_factor(statistics.live_scalars);
}

// Liveness takes longer than reading the module: the cache keeps the result, the two words of a double.
double cached_cost(const Words& words, const ShaderCache* cache) {
  if (cache == nullptr) return cost_of(words);
  Sha256 hash;
  hash.add_part("kernel cost " RGC_METHOD).add_part({reinterpret_cast<const char*>(words.data()), words.size() * sizeof(uint32_t)});
  const Digest key = hash.finish();
  if (const auto found = cache->find(key); found && found->size() == 1 && (*found)[0].size() == 2)
    return std::bit_cast<double>(uint64_t{(*found)[0][0]} | uint64_t{(*found)[0][1]} << 32);
  const double cost = cost_of(words);
  const auto bits = std::bit_cast<uint64_t>(cost);
  cache->store(key, {{static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)}});
  return cost;
}

// Nothing, each feature, everything, and what most tiles ask for.
std::set<Mask> sampled_sets(const SpectrumProblem& problem) {
  constexpr size_t kMasks = 32;
  std::set<Mask> sets = {0, static_cast<Mask>((uint64_t{1} << problem.features) - 1)};
  for (uint32_t a = 0; a < problem.features; ++a) sets.insert(close(problem, Mask{1} << a));
  std::vector<MaskWeight> masks = problem.histogram;
  std::stable_sort(masks.begin(), masks.end(), [](const MaskWeight& a, const MaskWeight& b) { return a.weight > b.weight; });
  for (size_t i = 0; i < std::min(kMasks, masks.size()); ++i) sets.insert(close(problem, masks[i].mask));
  return sets;
}

// The program in which the pass has kernels of these sets, and nothing to compile but them.
struct KernelProgram {
  dsl::Program program;
  VariantSpace space;
  std::vector<size_t> passes;  // by set
};
KernelProgram with_kernels(const dsl::Program& program, const User& user, const std::vector<Mask>& sets) {
  KernelProgram out{expand_spectra(program, {{user.pass->spectrum, sets}}), {}, std::vector<size_t>(sets.size(), SIZE_MAX)};
  const dsl::Graph& graph = out.program.graphs[user.graph];
  for (size_t p = 0; p < graph.passes.size(); ++p) {
    out.space.passes.emplace_back();
    for (size_t k = 0; k < sets.size(); ++k) {
      if (graph.passes.rows[p].name != kernel_name(user.pass->name, k)) continue;
      out.passes[k] = p;
      VariantRow row;
      for (const dsl::ShaderFeature& feature : graph.passes.rows[p].features)
        row.values.push_back(feature.feature.valid() ? program.features[feature.feature].initial : feature.value);
      out.space.passes.back().push_back(std::move(row));
    }
  }
  return out;
}

// The kernels of these sets, as they will be built. Empty where the shader does not compile: that is reported when it is built.
std::vector<double> measure_kernels(const dsl::Program& program, const User& user, const std::vector<Mask>& sets, const ReadFile& read,
                                    dsl::SourceFiles files, const SpectrumOptions& options) {
  const KernelProgram kernels = with_kernels(program, user, sets);
  dsl::Diagnostics ignored;
  const ShaderOptions measure{options.cache, options.workers, options.progress, ShaderEffort::measure};
  const ShaderBundle bundle = compile_shaders(kernels.program, user.graph, kernels.space, read, files, measure, ignored);
  std::vector<double> costs;
  for (const size_t pass : kernels.passes) {
    if (pass == SIZE_MAX || bundle.passes[pass].shaders.empty()) return {};
    costs.push_back(cached_cost(bundle.shaders[bundle.passes[pass].shaders[0]].words, options.cache));
  }
  return costs;
}

SpectrumProblem make_problem(const dsl::Spectrum& spectrum, const std::optional<SpectrumProfile>& profile, const SpectrumOptions& options) {
  SpectrumProblem problem;
  problem.features = static_cast<uint32_t>(spectrum.members.size());
  for (const dsl::Spectrum::Member& member : spectrum.members) {
    problem.needs.push_back(0);
    for (const uint32_t need : member.needs) problem.needs.back() |= Mask{1} << need;
  }
  problem.histogram = profile ? profile->histogram : assumed_profile(spectrum).histogram;
  for (MaskWeight& row : problem.histogram) row.mask |= options.force;
  problem.modes = options.modes.value_or(spectrum.modes);
  return problem;
}

using Times = std::vector<std::pair<Mask, double>>;

// Kernels have what their features require: the time of a set without is that of the set with it. Where there are several, their mean.
Times closed_times(const SpectrumProblem& problem, const std::optional<SpectrumProfile>& profile) {
  std::map<Mask, std::pair<double, int>> sums;
  if (profile)
    for (const auto& [set, ms] : profile->costs) sums[close(problem, set)].first += ms, ++sums[close(problem, set)].second;
  Times times;
  for (const auto& [set, sum] : sums) times.emplace_back(set, sum.first / sum.second);
  return times;
}

CostModel fitted(uint32_t features, std::vector<std::pair<Mask, double>> samples) {
  std::sort(samples.begin(), samples.end());
  CostModel model;
  model.work = fit_least_squares(features, samples);
  model.measured = std::move(samples);
  return model;
}

// Costs from the statistics of real kernels: a sample first, then whatever was chosen, until nothing is chosen unseen. `times` are known better.
ModeChoice choose_by_statistics(const dsl::Program& program, const User& user, SpectrumProblem& problem, const Times& times, const ReadFile& read,
                                const dsl::SourceFiles& files, const SpectrumOptions& options) {
  constexpr int kRounds = 6;
  problem.costs.work.features.assign(problem.features, 0.1);
  std::set<Mask> wanted = sampled_sets(problem), known;
  for (const auto& [set, time] : times) wanted.insert(set);  // they say what a unit of the statistics takes
  std::vector<std::pair<Mask, double>> samples;
  ModeChoice choice;
  for (int round = 0; round < kRounds && !wanted.empty(); ++round) {
    const std::vector<Mask> sets(wanted.begin(), wanted.end());
    const std::vector<double> costs = measure_kernels(program, user, sets, read, files, options);
    for (size_t i = 0; i < costs.size(); ++i) samples.emplace_back(sets[i], costs[i]);
    if (!costs.empty()) problem.costs = fitted(problem.features, times.empty() ? samples : complete_times(samples, times));
    choice = choose_modes(problem);
    known.insert(wanted.begin(), wanted.end());
    wanted.clear();
    for (const Mask set : choice.modes)
      if (!known.contains(set)) wanted.insert(set);
  }
  return choice;
}

// Of what all kernels are made from: they differ in the values of features alone, so two say it for all.
Digest digest_of_kernels(const dsl::Program& program, const User& user, const SpectrumProblem& problem, const ReadFile& read) {
  const KernelProgram kernels = with_kernels(program, user, {0, close(problem, static_cast<Mask>((uint64_t{1} << problem.features) - 1))});
  return digest_of_variants(kernels.program, user.graph, kernels.space, read);
}

// What an earlier build chose for this problem, whatever its shader was.
const SpectrumChoice* earlier_choice(const User& user, const SpectrumProblem& problem, const SpectrumOptions& options) {
  if (options.earlier == nullptr) return nullptr;
  const auto same = [&](const SpectrumChoice& other) {
    const SpectrumProblem& before = other.problem;
    return other.pass == user.pass->name && before.features == problem.features && before.needs == problem.needs && before.modes == problem.modes &&
           before.histogram == problem.histogram;
  };
  const auto found = std::find_if(options.earlier->begin(), options.earlier->end(), same);
  return found == options.earlier->end() ? nullptr : &*found;
}

// By statistics of kernels that are built for it; from the cache where nothing changed, and from an earlier build where it may be.
void choose_with_statistics(const dsl::Program& program, const User& user, const Times& times, SpectrumChoice& row, const ReadFile& read,
                            const dsl::SourceFiles& files, const SpectrumOptions& options) {
  const ShaderCache* cache = options.cache;
  row.problem.costs.measured = times;
  const Digest key = cache != nullptr ? choice_key(row.problem, digest_of_kernels(program, user, row.problem, read)) : Digest{};
  if (auto kept = cache != nullptr ? find_choice(*cache, key, row.problem) : std::nullopt) {
    row.problem.costs = std::move(kept->costs), row.choice = std::move(kept->choice);
    return;
  }
  if (const SpectrumChoice* earlier = earlier_choice(user, row.problem, options)) {
    row.problem.costs = earlier->problem.costs, row.choice = earlier->choice, row.provisional = true;
    return;
  }
  row.choice = choose_by_statistics(program, user, row.problem, times, read, files, options);
  if (cache != nullptr && !row.problem.costs.measured.empty()) store_choice(*cache, key, {row.problem.costs, row.choice});
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
    SpectrumChoice& row =
        choices.emplace_back(SpectrumChoice{dsl::SpectrumId{s}, users[0].pass->name, profile, make_problem(spectrum, profile, options)});
    const Times times = closed_times(row.problem, profile);
    if (tell_apart(row.problem.features, times)) {
      row.problem.costs = fitted(row.problem.features, times);
      row.choice = choose_modes(row.problem);
      row.source = CostSource::times;
    } else {
      row.source = times.empty() ? CostSource::statistics : CostSource::both;
      choose_with_statistics(program, users[0], times, row, read, files, options);
    }
  }
  return choices;
}

std::vector<KernelSets> kernel_sets(const std::vector<SpectrumChoice>& choices) {
  std::vector<KernelSets> sets;
  for (const SpectrumChoice& choice : choices)
    sets.push_back({choice.spectrum, choice.choice.modes, group_shares(choice.problem, choice.choice.modes)});
  return sets;
}

}  // namespace rg::compiler
