#include <algorithm>
#include <map>
#include <set>

#include "compiler/shaders/floor.h"
#include "compiler/shaders/shader_jobs.h"
#include "compiler/shaders/stage_interface.h"
#include "compiler/shaders/statistics.h"
#include "dsl/features.h"

namespace rg::compiler {
namespace {

// ---- one pass over all its configurations

// Front-end jobs of a shader, each once.
std::vector<size_t> distinct_jobs(const ShaderUse& use) {
  std::vector<size_t> jobs;
  for (const size_t job : use.jobs)
    if (std::find(jobs.begin(), jobs.end(), job) == jobs.end()) jobs.push_back(job);
  return jobs;
}

void merge(Reflection& all, const Reflection& more) {
  for (const ReflectedBinding& binding : more.bindings) {
    const auto same = [&](const ReflectedBinding& b) { return b.set == binding.set && b.binding == binding.binding && b.name == binding.name; };
    const auto found = std::find_if(all.bindings.begin(), all.bindings.end(), same);
    if (found == all.bindings.end())
      all.bindings.push_back(binding);
    else
      found->statically_used |= binding.statically_used;
  }
  for (const ReflectedStruct& record : more.structs)
    if (std::find(all.structs.begin(), all.structs.end(), record) == all.structs.end()) all.structs.push_back(record);
  all.push_constants_used |= more.push_constants_used;
}

void merge(ModuleUse& all, const ModuleUse& more) {
  all.touched |= more.touched;
  all.reads |= more.reads;
  all.writes |= more.writes;
  all.atomics |= more.atomics;
}

void merge(ModuleUses& all, const ModuleUses& more) {
  for (const auto& [place, use] : more.descriptors) merge(all.descriptors[place], use);
  for (const auto& [location, use] : more.outputs) merge(all.outputs[location], use);
  all.push_constants |= more.push_constants;
}

// What the shaders of a pass do in any of its configurations.
std::vector<StageOutput> stages_of_pass(const std::vector<ShaderUse>& uses, const std::vector<FrontEndResult>& results) {
  std::vector<StageOutput> stages;
  for (const ShaderUse& use : uses) {
    const std::vector<size_t> jobs = distinct_jobs(use);
    if (is_generated_fullscreen(use) || jobs.empty()) continue;
    StageOutput stage{use.shader.stage, use.path, use.shader.span, results[jobs[0]].reflection, results[jobs[0]].uses};
    for (size_t i = 1; i < jobs.size(); ++i) {
      merge(stage.reflection, results[jobs[i]].reflection);
      merge(stage.uses, results[jobs[i]].uses);
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

// Which values make a shader fail that compiles with others.
void note_failing_features(const PassContext& context, const ShaderUse& use, const std::vector<FrontEndResult>& results,
                           dsl::Diagnostics& diagnostics, size_t first_report) {
  std::vector<bool> fails;
  for (const size_t job : use.jobs) fails.push_back(!results[job].errors.empty());
  const auto good = std::find(fails.begin(), fails.end(), false);
  const auto smallest = smallest_failing_key(use.keys, fails);
  if (good == fails.end() || !smallest || diagnostics.rows().size() == first_report) return;
  dsl::Diagnostic last = diagnostics.rows().back();
  last.note(dsl::DiagnosticKind::FailsWithFeatures, context.pass.span,
            {key_text(context.pass, *smallest), key_text(context.pass, use.keys[static_cast<size_t>(good - fails.begin())])});
  diagnostics.replace_last(std::move(last));
}

// True if every shader of the pass compiled. A job's messages are reported for the first pass that uses it only, and of a shader's jobs
// only the first that fails: the others mostly say the same.
bool report_pass(const PassContext& context, const std::vector<ShaderUse>& uses, const std::vector<FrontEndResult>& results,
                 std::set<size_t>& reported, ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  bool good = true;
  for (const ShaderUse& use : uses) {
    const std::vector<size_t> jobs = distinct_jobs(use);
    const auto failed = std::find_if(jobs.begin(), jobs.end(), [&](size_t job) { return !results[job].errors.empty(); });
    if (failed == jobs.end()) continue;
    good = false;
    const bool seen = reported.contains(*failed);
    for (const size_t job : jobs)
      if (!results[job].errors.empty()) reported.insert(job);
    if (seen) continue;
    const size_t before = diagnostics.rows().size();
    const auto row = static_cast<size_t>(std::find(use.jobs.begin(), use.jobs.end(), *failed) - use.jobs.begin());
    const Prelude prelude = make_prelude(context.program, context.graph, context.pass, use.shader.stage, use.keys[row]);
    for (const ShaderMessage& message : results[*failed].errors) report_message(context, use.shader, prelude, message, places, diagnostics);
    note_failing_features(context, use, results, diagnostics, before);
  }
  return good;
}

// The state of the pass says what devices with the feature's capability do.
bool state_asks(const PassContext& context, const dsl::ShaderFeature& feature) {
  return context.pass.state.valid() && dsl::asks(context.program.states[context.pass.state], context.program.features[feature.feature].capability);
}

// A feature that no shader of its pass depends on, in the preprocessor or as a constant.
void check_features(const PassContext& context, const std::vector<ShaderUse>& uses, const std::vector<FrontEndResult>& results,
                    dsl::Diagnostics& diagnostics) {
  for (size_t i = 0; i < context.pass.features.size(); ++i) {
    const dsl::ShaderFeature& feature = context.pass.features[i];
    bool used = !feature.feature.valid() || state_asks(context, feature);
    for (const ShaderUse& use : uses)
      for (size_t row = 0; row < use.jobs.size(); ++row)
        used = used || use.keys[row][i] || results[use.jobs[row]].numbers.contains(kFirstFeatureConstant + static_cast<uint32_t>(i));
    if (!used) diagnostics.report(dsl::DiagnosticKind::FeatureNotUsed, feature.span, {feature.name, context.pass.name});
  }
}

// Vertex and fragment shaders as they meet in the rows of the pass; other stages between them would have a say.
void check_interfaces(const PassContext& context, const std::vector<ShaderUse>& uses, const std::vector<FrontEndResult>& results,
                      ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  if (uses.size() != 2 || uses[0].shader.stage != dsl::stage_vertex || uses[1].shader.stage != dsl::stage_fragment) return;
  std::set<std::pair<size_t, size_t>> checked;
  for (size_t row = 0; row < uses[0].jobs.size(); ++row) {
    const size_t vertex = uses[0].jobs[row], fragment = uses[1].jobs[row];
    if (!checked.emplace(vertex, fragment).second) continue;
    if (!check_stage_interface(context, uses[0], results[vertex].generic, uses[1], results[fragment].generic, places, diagnostics)) return;
  }
}

void check_outputs(const PassContext& context, const std::vector<ShaderUse>& uses, const std::vector<FrontEndResult>& results, ShaderPlaces& places,
                   dsl::Diagnostics& diagnostics) {
  std::set<size_t> checked;
  for (const ShaderUse& use : uses)
    for (const size_t job : use.jobs)
      if (use.shader.stage == dsl::stage_fragment && checked.insert(job).second &&
          !check_own_outputs(context, use, results[job].generic, places, diagnostics))
        return;
}

// ---- the bundle

class BundleBuilder {
 public:
  size_t add(dsl::Stage stage, const std::string& path, const Words& words) {
    const auto [at, is_new] = known_.try_emplace({stage, words}, bundle.shaders.size());
    if (!is_new) return at->second;
    const size_t number = ++uses_of_name_[path];
    bundle.shaders.push_back({number == 1 ? path : path + "." + std::to_string(number), stage, words, shared_bytes(words)});
    return bundle.shaders.size() - 1;
  }
  ShaderBundle bundle;

 private:
  std::map<std::pair<dsl::Stage, Words>, size_t> known_;
  std::map<std::string, size_t> uses_of_name_;
};

uint32_t used_stages(const std::vector<StageOutput>& stages, const InterfaceBinding& binding) {
  uint32_t optimised = 0, written = 0;
  for (const StageOutput& stage : stages) {
    const auto found = stage.uses.descriptors.find({1, binding.binding});
    if (found != stage.uses.descriptors.end() && found->second.touched) optimised |= stage.stage;
    for (const ReflectedBinding& reflected : stage.reflection.bindings)
      if (reflected.set == 1 && reflected.binding == binding.binding && reflected.statically_used) written |= stage.stage;
  }
  // What the optimiser removed from every stage still is an access of the program.
  return optimised != 0 ? optimised : written;
}

uint32_t host_stages(const dsl::Pass& pass, const InterfaceBinding& binding) {
  if (binding.access != dsl::kAll && pass.accesses[binding.access].stages != 0) return pass.accesses[binding.access].stages;
  if (pass.kind == dsl::PassKind::compute) return dsl::stage_compute;
  return binding.access != dsl::kAll ? static_cast<uint32_t>(dsl::stage_fragment) : dsl::stage_vertex | dsl::stage_fragment;
}

uint32_t push_stages(const dsl::Pass& pass, const std::vector<StageOutput>& stages) {
  if (!pass.draw.per_draw.valid()) return 0;
  if (stages.empty()) return dsl::stage_vertex | dsl::stage_fragment;
  uint32_t used = 0;
  for (const StageOutput& stage : stages) used |= stage.uses.push_constants || stage.reflection.push_constants_used ? stage.stage : 0u;
  return used;
}

PassShaders pass_shaders(const PassContext& context, const std::vector<StageOutput>& stages) {
  const dsl::Pass& pass = context.pass;
  PassShaders result;
  result.access_stages.assign(pass.accesses.size(), 0);
  result.params_stages.assign(pass.params.size(), 0);
  for (const InterfaceBinding& binding : pass_bindings(context.program, context.graph, pass)) {
    const uint32_t used = pass.shaders.empty() ? host_stages(pass, binding) : used_stages(stages, binding);
    if (binding.access != dsl::kAll)
      result.access_stages[binding.access] = used;
    else
      result.params_stages[binding.params] = used;
  }
  result.push_stages = push_stages(pass, stages);
  return result;
}

// ---- specialisations

constexpr size_t kNone = SIZE_MAX;

ConstantValues constants_of(const VariantRow& row, const std::set<uint32_t>& numbers) {
  ConstantValues values;
  for (size_t i = 0; i < row.values.size(); ++i)
    if (numbers.contains(kFirstFeatureConstant + static_cast<uint32_t>(i))) values.emplace_back(kFirstFeatureConstant + i, row.values[i]);
  return values;
}

// Jobs of all live variants, each once, and which of them a shader of a pass takes in a row.
struct Specialisations {
  std::vector<SpecialiseJob> jobs;
  std::vector<std::vector<std::vector<size_t>>> rows;  // [pass][shader][row], kNone where the row is not live
};

Specialisations collect_specialisations(const VariantSpace& space, const ShaderWork& work, const std::vector<FrontEndResult>& results,
                                        const std::vector<bool>& good) {
  Specialisations all;
  std::map<SpecialiseJob, size_t> known;
  all.rows.resize(work.passes.size());
  for (size_t p = 0; p < work.passes.size(); ++p) {
    if (!good[p]) continue;
    for (const ShaderUse& use : work.passes[p]) {
      std::vector<size_t> jobs(space.passes[p].size(), kNone);
      for (size_t r = 0; r < jobs.size(); ++r) {
        if (!space.passes[p][r].live) continue;
        SpecialiseJob job{use.jobs[r], constants_of(space.passes[p][r], results[use.jobs[r]].numbers)};
        const auto [at, is_new] = known.try_emplace(job, all.jobs.size());
        if (is_new) all.jobs.push_back(std::move(job));
        jobs[r] = at->second;
      }
      all.rows[p].push_back(std::move(jobs));
    }
  }
  return all;
}

VariantCount count_variants(const PassContext& context, const ShaderUse& use, const std::vector<VariantRow>& rows, const std::vector<size_t>& jobs,
                            const std::vector<size_t>& shaders) {
  VariantCount count{context.pass.name, use.path};
  std::set<std::vector<uint32_t>> feasible, reachable;
  for (const VariantRow& row : rows) {
    feasible.insert(row.values);
    if (row.live) reachable.insert(row.values);
  }
  std::set<size_t> distinct(jobs.begin(), jobs.end()), modules(shaders.begin(), shaders.end());
  distinct.erase(kNone);
  modules.erase(kNone);
  count.declared = combinations(context.program, context.pass);
  count.infeasible = count.declared - feasible.size();
  count.unreachable = feasible.size() - reachable.size();
  count.indifferent = reachable.size() - distinct.size();
  count.equal = distinct.size() - modules.size();
  count.built = modules.size();
  count.front_ends = distinct_jobs(use).size();
  return count;
}

void put(PassShaders& target, const VariantRow& row, size_t shader) {
  auto& selectors = target.variants[row.configuration];
  if (selectors.size() <= row.selector) selectors.resize(row.selector + 1);
  selectors[row.selector].push_back(shader);
  auto& values = target.values[row.configuration];
  values.resize(selectors.size());
  values[row.selector] = row.values;
}

void add_variants(const PassContext& context, const std::vector<ShaderUse>& uses, const std::vector<VariantRow>& rows,
                  const std::vector<std::vector<size_t>>& jobs, const std::vector<Words>& words, PassShaders& target, BundleBuilder& builder,
                  dsl::Diagnostics& diagnostics) {
  for (size_t u = 0; u < jobs.size(); ++u) {
    std::vector<size_t> shaders(rows.size(), kNone);
    bool within = true;  // the floor
    for (size_t r = 0; r < rows.size(); ++r) {
      if (jobs[u][r] == kNone) continue;
      within = within && check_floor(context, uses[u].shader, rows[r], words[jobs[u][r]], diagnostics);
      shaders[r] = builder.add(uses[u].shader.stage, uses[u].path, words[jobs[u][r]]);
      put(target, rows[r], shaders[r]);
    }
    if (!context.pass.features.empty() && !is_generated_fullscreen(uses[u]))
      builder.bundle.counts.push_back(count_variants(context, uses[u], rows, jobs[u], shaders));
  }
  // A choice for every combination, those that nobody can choose included.
  for (const VariantRow& row : rows) {
    auto& selectors = target.variants[row.configuration];
    if (!selectors.empty() && selectors.size() <= row.selector) selectors.resize(row.selector + 1);
    target.values[row.configuration].resize(selectors.size());
  }
  for (size_t r = rows.size(); r-- > 0;)
    if (rows[r].live && !jobs.empty()) target.shaders = target.variants[rows[r].configuration][rows[r].selector];
}

}  // namespace

VariantSpace initial_variants(const dsl::Program& program, dsl::GraphId graph) {
  VariantSpace space;
  for (const dsl::Pass& pass : program.graphs[graph].passes) {
    VariantRow row;
    for (const dsl::ShaderFeature& feature : pass.features)
      row.values.push_back(feature.feature.valid() ? program.features[feature.feature].initial : feature.value);
    space.passes.push_back({std::move(row)});
  }
  return space;
}

ShaderBundle compile_shaders(const dsl::Program& program, dsl::GraphId graph_id, const VariantSpace& space, const ReadFile& read,
                             dsl::SourceFiles& files, const ShaderOptions& options, dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  ShaderSources sources(read);
  ShaderPlaces places(files, sources);
  const ShaderWork work = collect_work(program, graph, space, sources, diagnostics);
  const std::vector<FrontEndResult> results = run_front_ends(work.jobs, sources, options);

  BundleBuilder builder;
  std::set<size_t> reported;
  std::vector<bool> good;
  for (size_t i = 0; i < graph.passes.size(); ++i) {
    const PassContext context{program, graph, graph.passes.rows[i]};
    good.push_back(report_pass(context, work.passes[i], results, reported, places, diagnostics));
    const std::vector<StageOutput> stages = good[i] ? stages_of_pass(work.passes[i], results) : std::vector<StageOutput>{};
    if (!stages.empty()) check_agreement(context, stages, places, diagnostics);
    if (!stages.empty()) check_interfaces(context, work.passes[i], results, places, diagnostics);
    if (!stages.empty()) check_outputs(context, work.passes[i], results, places, diagnostics);
    if (!stages.empty()) check_features(context, work.passes[i], results, diagnostics);
    builder.bundle.passes.push_back(pass_shaders(context, stages));
  }

  const Specialisations all = collect_specialisations(space, work, results, good);
  const Specialised modules = specialise(all.jobs, results, options);
  builder.bundle.complete = modules.complete;
  for (size_t i = 0; i < graph.passes.size(); ++i) {
    PassShaders& target = builder.bundle.passes[i];
    target.variants.resize(space.configurations);
    target.values.resize(space.configurations);
    target.selecting = space.selecting.empty() ? std::vector<std::vector<size_t>>(space.configurations) : space.selecting[i];
    if (good[i])
      add_variants({program, graph, graph.passes.rows[i]}, work.passes[i], space.passes[i], all.rows[i], modules.words, target, builder, diagnostics);
  }
  builder.bundle.read_files = sources.readable_paths();
  return std::move(builder.bundle);
}

dsl::Program resolve_stages(dsl::Program program, dsl::GraphId graph, const ShaderBundle& bundle) {
  auto& passes = program.graphs[graph].passes.rows;
  for (size_t i = 0; i < passes.size() && i < bundle.passes.size(); ++i)
    for (size_t a = 0; a < passes[i].accesses.size(); ++a)
      if (bundle.passes[i].access_stages[a] != 0) passes[i].accesses[a].stages = bundle.passes[i].access_stages[a];
  return program;
}

}  // namespace rg::compiler
