#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "compiler/shaders/agreement.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

// One distinct (path, stage, interface); loop instances of a pass usually share theirs.
struct Job {
  dsl::Stage stage = dsl::stage_compute;
  std::string path;
  std::string prelude;
  const std::string* text = nullptr;
};
struct JobOutput {
  std::vector<ShaderMessage> errors;
  Reflection reflection;
  ModuleUses uses;
  Words words;
};
// Jobs of each pass, one a shader in stage order. An empty row: the pass has no shaders, or one could not be read.
struct Work {
  std::vector<Job> jobs;
  std::vector<std::vector<size_t>> pass_jobs;
  std::vector<std::vector<dsl::Shader>> pass_shaders;
};

const std::string kFullscreenPath = "rgc/fullscreen.vert";
const std::string kNoPrelude, kFullscreenText = kFullscreenVertexShader;

std::vector<dsl::Shader> shaders_in_stage_order(const dsl::Pass& pass) {
  std::vector<dsl::Shader> shaders = pass.shaders;
  if (is_fullscreen(pass) && !shaders.empty()) shaders.push_back({dsl::stage_vertex, kFullscreenPath, shaders.front().span});
  std::stable_sort(shaders.begin(), shaders.end(), [](const auto& a, const auto& b) { return a.stage < b.stage; });
  return shaders;
}

size_t add_job(Work& work, Job job) {
  const auto same = [&](const Job& other) { return other.stage == job.stage && other.path == job.path && other.prelude == job.prelude; };
  const auto found = std::find_if(work.jobs.begin(), work.jobs.end(), same);
  if (found != work.jobs.end()) return static_cast<size_t>(found - work.jobs.begin());
  work.jobs.push_back(std::move(job));
  return work.jobs.size() - 1;
}

// The checker made the shader's path relative to the root folder.
std::optional<Job> make_job(const PassContext& context, const dsl::Shader& shader, ShaderSources& sources, dsl::Diagnostics& diagnostics) {
  if (shader.path == kFullscreenPath) return Job{shader.stage, kFullscreenPath, kNoPrelude, &kFullscreenText};
  const auto path = resolve_path("", shader.path);
  if (!path) {
    diagnostics.report(dsl::DiagnosticKind::ShaderNotReadable, shader.span, {shader.path, "it lies outside the root file's folder"});
    return std::nullopt;
  }
  const std::string* source = sources.find(*path);
  if (source == nullptr) {
    diagnostics.report(dsl::DiagnosticKind::ShaderNotReadable, shader.span, {shader.path, "no such file, or no permission"});
    return std::nullopt;
  }
  return Job{shader.stage, *path, text(make_prelude(context.program, context.graph, context.pass, shader.stage)), source};
}

Work collect_work(const dsl::Program& program, const dsl::Graph& graph, ShaderSources& sources,
                  dsl::Diagnostics& diagnostics) {
  Work work;
  for (const dsl::Pass& pass : graph.passes) {
    check_stages(pass, diagnostics);
    std::vector<size_t> jobs;
    std::vector<dsl::Shader> shaders = shaders_in_stage_order(pass);
    for (const dsl::Shader& shader : shaders)
      if (auto job = make_job({program, graph, pass}, shader, sources, diagnostics)) jobs.push_back(add_job(work, std::move(*job)));
    if (jobs.size() != shaders.size()) jobs.clear();
    work.pass_jobs.push_back(std::move(jobs));
    work.pass_shaders.push_back(std::move(shaders));
  }
  return work;
}

JobOutput run_job(const Job& job, ShaderSources& sources) {
  FrontEndOutput front_end = compile_glsl(job.stage, job.prelude, job.path, *job.text, sources);
  JobOutput output;
  output.errors = std::move(front_end.errors);
  if (!output.errors.empty()) return output;
  const std::string problem = validate_spirv(front_end.words);
  if (!problem.empty()) {
    output.errors.push_back({job.path, 1, "SPIR-V is not valid: " + problem});
    return output;
  }
  output.reflection = reflect(front_end.words);
  const Words optimised = optimise_spirv(front_end.words);
  output.uses = find_uses(optimised);
  output.words = strip_spirv(optimised);
  RG_CHECK(validate_spirv(output.words).empty(), "optimised SPIR-V is not valid");
  return output;
}

// Two workers take jobs in order; each result has its own place, so that the outcome does not depend on who was faster.
std::vector<JobOutput> run_jobs(const std::vector<Job>& jobs, ShaderSources& sources) {
  std::vector<JobOutput> outputs(jobs.size());
  std::atomic<size_t> next = 0;
  const auto work = [&] {
    for (size_t i = next++; i < jobs.size(); i = next++) outputs[i] = run_job(jobs[i], sources);
  };
  std::thread other(work);
  work();
  other.join();
  return outputs;
}

std::vector<StageOutput> stages_of_pass(const Work& work, size_t pass, const std::vector<JobOutput>& outputs) {
  std::vector<StageOutput> stages;
  for (size_t i = 0; i < work.pass_jobs[pass].size(); ++i) {
    const size_t job = work.pass_jobs[pass][i];
    if (work.jobs[job].path == kFullscreenPath) continue;
    const dsl::Shader& shader = work.pass_shaders[pass][i];
    stages.push_back({shader.stage, work.jobs[job].path, shader.span, outputs[job].reflection, outputs[job].uses});
  }
  return stages;
}

// True if every shader of the pass compiled. A job's messages are reported for the first pass that uses it only.
bool report_pass(const PassContext& context, const Work& work, size_t pass, const std::vector<JobOutput>& outputs, std::set<size_t>& reported,
                 ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  bool good = true;
  for (size_t i = 0; i < work.pass_jobs[pass].size(); ++i) {
    const size_t job = work.pass_jobs[pass][i];
    if (outputs[job].errors.empty()) continue;
    good = false;
    if (!reported.insert(job).second) continue;
    const dsl::Shader& shader = work.pass_shaders[pass][i];
    const Prelude prelude = make_prelude(context.program, context.graph, context.pass, shader.stage);
    for (const ShaderMessage& message : outputs[job].errors) report_message(context, shader, prelude, message, places, diagnostics);
  }
  return good;
}

// ---- the bundle

class BundleBuilder {
 public:
  size_t add(const Job& job, const Words& words) {
    for (size_t i = 0; i < bundle.shaders.size(); ++i)
      if (bundle.shaders[i].stage == job.stage && bundle.shaders[i].words == words) return i;
    const size_t number = ++uses_of_name_[job.path];
    bundle.shaders.push_back({number == 1 ? job.path : job.path + "." + std::to_string(number), job.stage, words});
    return bundle.shaders.size() - 1;
  }
  ShaderBundle bundle;

 private:
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

}  // namespace

ShaderBundle compile_shaders(const dsl::Program& program, dsl::GraphId graph_id, const ReadFile& read, dsl::SourceFiles& files,
                             dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  ShaderSources sources(read);
  ShaderPlaces places(files, sources);
  const Work work = collect_work(program, graph, sources, diagnostics);
  const std::vector<JobOutput> outputs = run_jobs(work.jobs, sources);

  BundleBuilder builder;
  std::set<size_t> reported;
  for (size_t i = 0; i < graph.passes.size(); ++i) {
    const PassContext context{program, graph, graph.passes[dsl::PassId{i}]};
    const bool good = report_pass(context, work, i, outputs, reported, places, diagnostics);
    const std::vector<StageOutput> stages = good ? stages_of_pass(work, i, outputs) : std::vector<StageOutput>{};
    if (!stages.empty()) check_agreement(context, stages, places, diagnostics);
    builder.bundle.passes.push_back(pass_shaders(context, stages));
    if (!good) continue;
    for (const size_t job : work.pass_jobs[i]) builder.bundle.passes.back().shaders.push_back(builder.add(work.jobs[job], outputs[job].words));
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
