#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/commands/outputs.h"
#include "compiler/commands/spectrum_page.h"

namespace rg::commands {
namespace {

// Expected cost by number of kernels, from one to a few more than there are.
std::vector<double> curve_of(const compiler::SpectrumChoice& choice) {
  constexpr uint32_t kBeyond = 4;
  std::vector<double> costs;
  compiler::SpectrumProblem problem = choice.problem;
  const uint32_t most = std::min<uint32_t>(32, choice.problem.modes + kBeyond);
  for (problem.modes = 1; problem.modes <= most; ++problem.modes) {
    costs.push_back(compiler::choose_modes(problem).expected);
    if (costs.back() <= choice.choice.kernel_per_mask * (1 + 1e-12)) break;
  }
  return costs;
}

std::string name_of(compiler::CostSource source) {
  switch (source) {
    case compiler::CostSource::times:
      return "times";
    case compiler::CostSource::both:
      return "times and statistics";
    default:
      return "statistics";
  }
}

SpectrumFacts facts_of(const dsl::Program& program, const compiler::SpectrumChoice& choice) {
  const dsl::Spectrum& spectrum = program.spectra[choice.spectrum];
  const compiler::ModeChoice& c = choice.choice;
  SpectrumFacts facts;
  facts.name = spectrum.name, facts.pass = choice.pass;
  for (const dsl::Spectrum::Member& member : spectrum.members) facts.features.push_back(member.name);
  facts.measured = choice.profile.has_value();
  facts.costs = name_of(choice.source);
  if (choice.profile) facts.scenes = choice.profile->scenes, facts.tiles = choice.profile->tiles;
  facts.expected = c.expected, facts.bound = c.bound, facts.exact = c.exact;
  facts.one_kernel = c.one_kernel, facts.kernel_per_mask = c.kernel_per_mask;
  facts.curve = curve_of(choice);
  facts.modes = choice.problem.modes;
  double total = 0;
  for (const auto& row : choice.problem.histogram) total += row.weight;
  for (size_t k = 0; k < c.modes.size(); ++k) facts.kernels.push_back({c.modes[k], c.costs[k], 0});
  for (size_t i = 0; i < choice.problem.histogram.size(); ++i) {
    const auto& row = choice.problem.histogram[i];
    const uint32_t mode = c.mode_of[i];
    facts.kernels[mode].share += row.weight / total;
    const double own = compiler::cost(choice.problem.costs, compiler::close(choice.problem, row.mask));
    facts.masks.push_back({row.mask, row.weight / total, mode, c.modes[mode] & ~row.mask, c.costs[mode], std::min(own, c.costs[mode])});
  }
  std::stable_sort(facts.masks.begin(), facts.masks.end(), [](const MaskFacts& a, const MaskFacts& b) { return a.share > b.share; });
  return facts;
}

std::string text_of(const SpectrumFacts& facts) {
  constexpr size_t kShown = 20;
  std::string text =
      fmt::format("spectrum {} of {}: {} of at most {}, {}\n", facts.name, facts.pass, counted(facts.kernels.size(), "kernel"), facts.modes,
                  facts.measured ? fmt::format("{:.0f} tiles in {}", facts.tiles, counted(facts.scenes.size(), "scene")) : "no profile");
  text +=
      fmt::format("  expected cost {:.4g}, {}\n", facts.expected,
                  facts.exact ? "the optimum" : fmt::format("within {:.2f} % of the optimum", 100 * (facts.expected - facts.bound) / facts.expected));
  text += fmt::format("  one kernel for all {:.4g} ({:.2f} x), a kernel for every mask {:.4g} ({:.2f} x)\n", facts.one_kernel,
                      facts.one_kernel / facts.expected, facts.kernel_per_mask, facts.kernel_per_mask / facts.expected);
  for (size_t k = 1; k < facts.curve.size(); ++k)
    text +=
        fmt::format("  {:>2} kernels {:>10.4g}  {:5.2f} % less than {}\n", k + 1, facts.curve[k], 100 * (1 - facts.curve[k] / facts.curve[k - 1]), k);
  text += "  kernel      cost    tiles  features\n";
  for (size_t k = 0; k < facts.kernels.size(); ++k)
    text +=
        fmt::format("  {:>6} {:>9.4g} {:>6.2f} %  {}\n", k, facts.kernels[k].cost, 100 * facts.kernels[k].share, facts.names(facts.kernels[k].set));
  text += "  tiles     kernel  in vain  features; those it pays for in vain\n";
  for (size_t i = 0; i < std::min(kShown, facts.masks.size()); ++i) {
    const MaskFacts& row = facts.masks[i];
    text += fmt::format("  {:>6.2f} % {:>6} {:>+6.1f} %  {}{}\n", 100 * row.share, row.kernel, 100 * (row.cost / row.own - 1), facts.names(row.mask),
                        row.superfluous == 0 ? "" : "; " + facts.names(row.superfluous));
  }
  if (facts.masks.size() > kShown) text += fmt::format("  and {} more\n", facts.masks.size() - kShown);
  return text;
}

nlohmann::ordered_json names_json(const SpectrumFacts& facts, uint32_t set) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (size_t i = 0; i < facts.features.size(); ++i)
    if (set >> i & 1) names.push_back(facts.features[i]);
  return names;
}

nlohmann::ordered_json json_of(const SpectrumFacts& facts) {
  nlohmann::ordered_json json = {
      {"spectrum", facts.name},   {"pass", facts.pass},     {"features", facts.features},     {"measured", facts.measured},
      {"costs", facts.costs},     {"scenes", facts.scenes}, {"tiles", facts.tiles},           {"expected", facts.expected},
      {"bound", facts.bound},     {"exact", facts.exact},   {"one_kernel", facts.one_kernel}, {"kernel_per_mask", facts.kernel_per_mask},
      {"by_kernels", facts.curve}};
  for (const KernelFacts& kernel : facts.kernels)
    json["kernels"].push_back({{"features", names_json(facts, kernel.set)}, {"cost", kernel.cost}, {"share", kernel.share}});
  for (const MaskFacts& mask : facts.masks)
    json["masks"].push_back({{"features", names_json(facts, mask.mask)},
                             {"share", mask.share},
                             {"kernel", mask.kernel},
                             {"superfluous", names_json(facts, mask.superfluous)},
                             {"cost", mask.cost},
                             {"own_cost", mask.own}});
  return json;
}

int report_all(const SpectrumCommand& options, const compiler::CompileResult& result, dsl::Diagnostics& diagnostics) {
  std::vector<SpectrumFacts> all;
  for (const compiler::SpectrumChoice& choice : result.spectra) all.push_back(facts_of(result.program, choice));
  nlohmann::ordered_json json = {{"schema", "rgc-spectrum-report-1"}, {"spectra", nlohmann::ordered_json::array()}};
  for (const SpectrumFacts& facts : all) {
    if (!options.json) print(text_of(facts));
    json["spectra"].push_back(json_of(facts));
  }
  if (options.json) print(json.dump(2) + "\n");
  if (!options.html.empty() && may_write({{"the page", options.html}}, {}, result.read_files, diagnostics))
    write_file(options.html, spectrum_page(all), diagnostics);
  return finish(diagnostics, result.sources);
}

}  // namespace

int spectrum(const SpectrumCommand& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::shaders;
  compile.read_profile = [](const std::string& path, std::string& why) { return read_file(path, why); };
  const auto result = compile_or_report(options.file, compile);
  if (!result) return exit_input_wrong;
  dsl::Diagnostics diagnostics;
  if (result->spectra.empty()) diagnostics.report(dsl::DiagnosticKind::NoSpectrum, {}, {options.file});
  if (result->spectra.empty()) return finish(diagnostics, result->sources);
  return report_all(options, *result, diagnostics);
}

}  // namespace rg::commands
