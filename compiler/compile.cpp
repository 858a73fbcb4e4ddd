#include "compiler/compile.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include "compiler/check_queues.h"
#include "compiler/check_reach.h"
#include "compiler/check_switches.h"
#include "compiler/codegen/bind.h"
#include "compiler/configurations.h"
#include "compiler/fusion/fusion_figures.h"
#include "compiler/judge.h"
#include "compiler/merge_features.h"
#include "compiler/profiles.h"
#include "compiler/variant_space.h"

namespace rg::compiler {
namespace {

std::string in_folder_of(const std::string& root_path, const std::string& path) {
  return (std::filesystem::path(root_path).parent_path() / path).lexically_normal().string();
}

// Shader sources come through the same reader as .rg files, relative to the root file's folder.
ReadFile shader_reader(const std::string& root_path, const dsl::ReadSource& read) {
  return [=](const std::string& path, std::string& why) { return read(in_folder_of(root_path, path), why); };
}

void tell(const CompileOptions& options, const std::string& what) {
  if (options.progress) options.progress(what);
}

// Whatever was read, by whichever phase and thread.
class ReadLog {
 public:
  dsl::ReadSource reader(dsl::ReadSource read) {
    return [this, read = std::move(read)](const std::string& path, std::string& why) {
      std::optional<std::string> text = read(path, why);
      const std::lock_guard lock(mutex_);
      if (text) paths_.push_back(path);
      return text;
    };
  }
  std::vector<std::string> take() {
    if (paths_.empty()) return {};
    std::sort(paths_.begin() + 1, paths_.end());  // the root file is read first
    const std::string root = paths_.front();
    paths_.erase(std::unique(paths_.begin() + 1, paths_.end()), paths_.end());
    paths_.erase(std::remove(paths_.begin() + 1, paths_.end(), root), paths_.end());
    return std::move(paths_);
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> paths_;
};

std::vector<SpectrumChoice> choose_kernels(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options,
                                           const ShaderCache* cache, CompileResult& result, dsl::Diagnostics& diagnostics) {
  if (result.program.spectra.empty()) return {};
  const ReadFile replaced = [&](const std::string& path, std::string& why) {
    return options.read_profile ? options.read_profile(path, why) : read(path, why);
  };
  Mask force = 0;
  for (const std::string& name : options.forced_features) {
    const Mask before = force;
    for (const dsl::Spectrum& spectrum : result.program.spectra)
      for (size_t i = 0; i < spectrum.members.size(); ++i)
        if (spectrum.members[i].name == name) force |= Mask{1} << i;
    if (force == before) diagnostics.report(dsl::DiagnosticKind::UnknownName, {}, {"feature of a spectrum", name});
  }
  const SpectrumOptions spectrum_options{options.spectrum_profile, options.spectrum_modes, force,          cache,
                                         options.workers,          options.progress,       options.earlier};
  return resolve_spectra(result.program, shader_reader(root_path, read), replaced, result.sources, spectrum_options, diagnostics);
}

void make_kernels(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, CompileResult& result,
                  dsl::Diagnostics& diagnostics) {
  const ReadFile reader = shader_reader(root_path, read);
  FusionResult fusion = fuse_passes(result.program, reader, result.sources, {options.fuse, options.halves}, diagnostics);
  result.written = std::exchange(result.program, std::move(fusion.program));
  result.fused = std::move(fusion.kernels);
  result.not_fused = std::move(fusion.refusals);
}

// Renderings clear and resolve by themselves where passes of their own would.
void fold(const CompileOptions& options, CompileResult& result) {
  FoldResult folded = fold_transfers(result.program, options.plan, options.fixed_features, options.max_plans);
  result.unfolded = std::exchange(result.program, std::move(folded.program));
  result.folded = std::move(folded.folds);
  result.not_folded = std::move(folded.refusals);
}

// What the cache went through, reported where it is not as it should be.
ShaderCache::Counts settle(const ShaderCache& cache, dsl::Diagnostics& diagnostics) {
  const ShaderCache::Counts counts = cache.counts();
  if (counts.damaged > 0) diagnostics.report(dsl::DiagnosticKind::CacheDamaged, {}, {cache.folder(), std::to_string(counts.damaged)});
  if (counts.failed > 0) diagnostics.report(dsl::DiagnosticKind::CacheNotWritable, {}, {cache.folder()});
  if (counts.stored > 0) cache.trim();
  return counts;
}

// Shaders of the plans that have to exist, and of no others.
CompiledGraph compile_graph_shaders(const std::string& root_path, const dsl::ReadSource& read, dsl::GraphId id, const CompileOptions& options,
                                    const ShaderCache* cache, CompileResult& result, dsl::Diagnostics& diagnostics) {
  const std::string& name = result.program.graphs[id].name;
  tell(options, "shaders of " + name);
  CompiledGraph graph{id, {}, {}, expand_configurations(result.program, id, options.fixed_features, options.max_plans, diagnostics), {}};
  const auto progress = [&](std::string_view what) { tell(options, name + ": " + std::string(what)); };
  const ShaderOptions shader_options{cache, options.workers, progress, options.preview ? ShaderEffort::preview : ShaderEffort::product};
  graph.space = find_variant_space(result.program, id, graph.configurations, diagnostics);
  graph.shaders = compile_shaders(result.program, id, graph.space, shader_reader(root_path, read), result.sources, shader_options, diagnostics);
  return graph;
}

// One machine's part of the shaders of a graph, or the list of all parts.
void run_graph_tasks(const std::string& root_path, const dsl::ReadSource& read, dsl::GraphId id, const CompileOptions& options,
                     const ShaderCache* cache, CompileResult& result, dsl::Diagnostics& diagnostics) {
  const auto configurations = expand_configurations(result.program, id, options.fixed_features, options.max_plans, diagnostics);
  const VariantSpace space = find_variant_space(result.program, id, configurations, diagnostics);
  if (diagnostics.has_errors()) return;
  const ReadFile reader = shader_reader(root_path, read);
  if (options.list_tasks) {
    for (ShaderTask& task : list_tasks(result.program, id, space, reader, diagnostics)) result.tasks.push_back(std::move(task));
    return;
  }
  build_shard(result.program, id, space, reader, result.sources, {cache, options.workers, options.progress}, options.shard, options.shards,
              diagnostics);
}

CompileResult run_tasks(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, const ShaderCache* cache,
                        CompileResult result, dsl::Diagnostics& diagnostics) {
  for (size_t g = 0; g < result.program.graphs.size(); ++g) run_graph_tasks(root_path, read, dsl::GraphId{g}, options, cache, result, diagnostics);
  if (cache) result.cache = settle(*cache, diagnostics);
  return result;
}

// Of devices that can run this plan: features of the device that are on in its configuration, and several views at once.
std::vector<Capability> needs_of(const dsl::Program& program, dsl::GraphId graph, const Configuration& configuration,
                                 const std::vector<Rendering>& renderings) {
  std::vector<Capability> needs;
  const std::vector<bool> of_plans = features_of_plans(program, program.graphs[graph]);
  for (size_t f = 0; f < of_plans.size(); ++f) {
    const dsl::Feature& feature = program.features.rows[f];
    if (of_plans[f] && feature.capability != dsl::Capability::none && configuration[f] == 1) needs.push_back(plan_capability(feature.capability));
  }
  const bool views = std::any_of(renderings.begin(), renderings.end(), [](const Rendering& rendering) { return rendering.view_mask != 0; });
  if (views && std::find(needs.begin(), needs.end(), Capability::multiview) == needs.end()) needs.push_back(Capability::multiview);
  return needs;
}

std::vector<FramePlan> plan_all(const CompileResult& result, const CompiledGraph& graph, const CompileOptions& options,
                                dsl::Diagnostics& diagnostics) {
  const dsl::Program& program = result.program;
  PlanOptions plan_options = options.plan;
  if (!options.profile.empty()) plan_options.measured_us = measured_times(program, graph.graph, options.profile, options.profile_text, diagnostics);
  std::vector<FramePlan> plans;
  for (const Configuration& configuration : graph.configurations) {
    tell(options, "plan of " + program.graphs[graph.graph].name + " " + configuration_name(program, configuration));
    FramePlan plan = plan_frame(program, graph.graph, configuration, plan_options);
    plan.plan.variant = static_cast<uint32_t>(plans.size());
    plan.plan.variant_count = static_cast<uint32_t>(graph.configurations.size());
    plan.plan.variant_name = intern(configuration_name(program, configuration));
    plan.plan.needs = needs_of(program, graph.graph, configuration, plan.plan.renderings);
    attach_shaders(plan.plan, program, graph.graph, graph.shaders, plans.size());
    for (FusionNote& note : fusion_notes(result.written, result.fused, result.not_fused, graph.graph))
      plan.decisions.push_back({std::move(note.subject), std::move(note.what), std::move(note.reason)});
    for (Decision& decision : fold_decisions(result.folded, result.not_folded, graph.graph)) plan.decisions.push_back(std::move(decision));
    plans.push_back(std::move(plan));
  }
  return plans;
}

// Text to program, with what target profiles promise.
void load(const std::string& root_path, const dsl::ReadSource& read, CompileResult& result, dsl::Diagnostics& diagnostics) {
  dsl::FrontEndResult front = dsl::load_program(root_path, read, diagnostics);
  result.sources = std::move(front.files);
  if (diagnostics.has_errors()) return;
  result.program = read_profiles(std::move(front.program), shader_reader(root_path, read), diagnostics);
}

// What the graphs ask of devices, beside what the target profiles promise.
void judge_devices(const CompileResult& result, dsl::Diagnostics& diagnostics) {
  for (const CompiledGraph& graph : result.graphs) {
    judge_profiles(result.program, graph.graph, graph.shaders, diagnostics);
    judge_memory(result.program, graph.graph, diagnostics);
  }
}

// What switches name, and queues that passes insist on.
void judge_demands(const std::string& root_path, const CompileResult& result, const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  check_switches(root_path, result.unfolded, result.program, options.plan, diagnostics);
  for (const CompiledGraph& graph : result.graphs) {
    check_queues(result.program, graph.graph, graph.configurations, diagnostics);
    check_first_queue(result.program, graph.graph, graph.configurations, options.plan, diagnostics);
  }
}

// What no plan of any configuration runs, and what the program asserts about its plans.
void judge_plans(const CompileResult& result, const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  for (const CompiledGraph& graph : result.graphs)
    if (options.fixed_features.empty()) check_reach(result.program, graph.graph, graph.plans, diagnostics);
  for (const CompiledGraph& graph : result.graphs) judge(result.program, graph.graph, graph.plans, options.plan, diagnostics);
}

// Now that every warning has been given.
void judge_allowances(dsl::Diagnostics& diagnostics) {
  for (const dsl::Allowance& useless : diagnostics.useless()) {
    const std::string code(dsl::row(useless.kind).code);
    diagnostics.report(
        dsl::Diagnostic(dsl::DiagnosticKind::AllowsNothing, useless.at, {code, "nothing here gives this warning"}).fix(useless.at, ""));
  }
}

std::vector<GraphOutput> outputs_of(const CompileResult& result) {
  std::vector<GraphOutput> outputs;
  for (const CompiledGraph& graph : result.graphs) outputs.push_back({graph.graph, &graph.plans});
  return outputs;
}

// The whole compiler, top to bottom. Each step consumes only what is above it.
CompileResult run(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  CompileResult result;

  // Text to program: lex, parse, check, with all imports.
  tell(options, root_path);
  load(root_path, read, result, diagnostics);
  diagnostics.judge_by(options.warnings);
  if (diagnostics.has_errors() || options.until == Until::program) return result;

  // Which kernels serve which tiles; passes with a spectrum become those that run it.
  const std::optional<ShaderCache> cache =
      options.cache_folder.empty() ? std::nullopt : std::optional<ShaderCache>(std::in_place, options.cache_folder, options.cache_bytes);
  result.spectra = choose_kernels(root_path, read, options, cache ? &*cache : nullptr, result, diagnostics);
  for (const SpectrumChoice& choice : result.spectra) result.complete = result.complete && !choice.provisional;
  if (diagnostics.has_errors()) return result;
  result.program = expand_spectra(std::move(result.program), kernel_sets(result.spectra));

  // Features that only remove passes become conditions.
  result.program = merge_features(std::move(result.program), options.fixed_features);

  // Blocks become kernels, one by one or several together.
  make_kernels(root_path, read, options, result, diagnostics);
  if (diagnostics.has_errors()) return result;

  // Passes that only clear or resolve become part of the renderings next to them.
  fold(options, result);

  // Which plans have to exist, and their shaders behind generated interfaces; what those really touch completes the declared accesses.
  if (options.list_tasks || options.shards > 0) return run_tasks(root_path, read, options, cache ? &*cache : nullptr, std::move(result), diagnostics);
  for (size_t g = 0; g < result.program.graphs.size(); ++g)
    result.graphs.push_back(compile_graph_shaders(root_path, read, dsl::GraphId{g}, options, cache ? &*cache : nullptr, result, diagnostics));
  for (const CompiledGraph& graph : result.graphs) result.complete = result.complete && graph.shaders.complete;
  if (cache) result.cache = settle(*cache, diagnostics);

  // The gate: later phases cannot fail on user input; what they find is judged at the end.
  if (diagnostics.has_errors()) return result;
  for (const CompiledGraph& graph : result.graphs) result.program = resolve_stages(std::move(result.program), graph.graph, graph.shaders);

  judge_devices(result, diagnostics);
  if (diagnostics.has_errors() || options.until == Until::shaders) return result;

  // What the command line and the passes insist on.
  judge_demands(root_path, result, options, diagnostics);
  if (diagnostics.has_errors()) return result;

  // Program to plans, one a configuration.
  for (CompiledGraph& graph : result.graphs) graph.plans = plan_all(result, graph, options, diagnostics);

  judge_plans(result, options, diagnostics);
  if (options.fixed_features.empty() && !options.preview) judge_allowances(diagnostics);
  if (diagnostics.has_errors() || options.until == Until::plans) return result;

  // Plans and SPIR-V to files.
  tell(options, "generated files");
  result.files = generate(result.program, outputs_of(result), result.sources, options.command);
  return result;
}

}  // namespace

CompileResult compile(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, dsl::Diagnostics& diagnostics) {
  ReadLog log;
  CompileOptions logged = options;
  if (options.read_profile) logged.read_profile = log.reader(options.read_profile);
  CompileResult result = run(root_path, log.reader(read), logged, diagnostics);
  result.read_files = log.take();
  if (!options.profile.empty()) result.read_files.push_back(options.profile);
  return result;
}

}  // namespace rg::compiler
