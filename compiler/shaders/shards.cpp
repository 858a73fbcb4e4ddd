// The variants of a graph as tasks, so that other machines can build some of them.
#include <algorithm>
#include <set>

#include "compiler/shaders/shader_jobs.h"

namespace rg::compiler {
namespace {

// One distinct (front-end job, feature values).
struct Task {
  size_t front_end = 0;
  std::vector<uint32_t> values;
  size_t pass = 0, use = 0, row = 0;  // of the first that needs it
};

std::vector<Task> find_tasks(const ShaderWork& work, const VariantSpace& space) {
  std::vector<Task> tasks;
  std::set<std::pair<size_t, std::vector<uint32_t>>> known;
  for (size_t p = 0; p < work.passes.size(); ++p)
    for (size_t u = 0; u < work.passes[p].size(); ++u)
      for (size_t r = 0; r < space.passes[p].size(); ++r) {
        const VariantRow& row = space.passes[p][r];
        const size_t job = work.passes[p][u].jobs[r];
        if (row.live && known.emplace(job, row.values).second) tasks.push_back({job, row.values, p, u, r});
      }
  return tasks;
}

FixedFeatures all_values(const std::vector<uint32_t>& values) { return {values.begin(), values.end()}; }

// Results by front-end job; those that no task of the shard needs stay empty.
std::vector<FrontEndResult> run_needed(const ShaderWork& work, const std::vector<Task>& tasks, ShaderSources& sources, const ShaderOptions& options) {
  std::vector<size_t> needed;
  for (const Task& task : tasks)
    if (std::find(needed.begin(), needed.end(), task.front_end) == needed.end()) needed.push_back(task.front_end);
  std::vector<FrontEndJob> jobs;
  for (const size_t job : needed) jobs.push_back(work.jobs[job]);
  std::vector<FrontEndResult> found = run_front_ends(jobs, sources, options), results(work.jobs.size());
  for (size_t i = 0; i < needed.size(); ++i) results[needed[i]] = std::move(found[i]);
  return results;
}

void report_errors(const dsl::Program& program, const dsl::Graph& graph, const ShaderWork& work, const Task& task, const FrontEndResult& result,
                   ShaderPlaces& places, dsl::Diagnostics& diagnostics) {
  const PassContext context{program, graph, graph.passes.rows[task.pass]};
  const ShaderUse& use = work.passes[task.pass][task.use];
  const Prelude prelude = make_prelude(program, graph, context.pass, use.shader.stage, use.keys[task.row]);
  for (const ShaderMessage& message : result.errors) report_message(context, use.shader, prelude, message, places, diagnostics);
}

}  // namespace

std::vector<ShaderTask> list_tasks(const dsl::Program& program, dsl::GraphId graph_id, const VariantSpace& space, const ReadFile& read,
                                   dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  ShaderSources sources(read);
  const ShaderWork work = collect_work(program, graph, space, sources, diagnostics);
  std::vector<ShaderTask> listed;
  for (const Task& task : find_tasks(work, space)) {
    const dsl::Pass& pass = graph.passes.rows[task.pass];
    listed.push_back({pass.name, work.passes[task.pass][task.use].path, key_text(pass, all_values(task.values))});
  }
  return listed;
}

void build_shard(const dsl::Program& program, dsl::GraphId graph_id, const VariantSpace& space, const ReadFile& read, dsl::SourceFiles& files,
                 const ShaderOptions& options, unsigned shard, unsigned shards, dsl::Diagnostics& diagnostics) {
  const dsl::Graph& graph = program.graphs[graph_id];
  ShaderSources sources(read);
  ShaderPlaces places(files, sources);
  const ShaderWork work = collect_work(program, graph, space, sources, diagnostics);
  std::vector<Task> tasks, all = find_tasks(work, space);
  for (size_t i = shard; i < all.size(); i += shards) tasks.push_back(std::move(all[i]));
  const std::vector<FrontEndResult> results = run_needed(work, tasks, sources, options);
  std::set<SpecialiseJob> jobs;
  std::set<size_t> reported;
  for (const Task& task : tasks) {
    const FrontEndResult& result = results[task.front_end];
    if (!result.errors.empty()) {
      if (reported.insert(task.front_end).second) report_errors(program, graph, work, task, result, places, diagnostics);
      continue;
    }
    SpecialiseJob job{task.front_end, {}};
    for (size_t i = 0; i < task.values.size(); ++i)
      if (result.numbers.contains(kFirstFeatureConstant + static_cast<uint32_t>(i)))
        job.values.emplace_back(kFirstFeatureConstant + i, task.values[i]);
    jobs.insert(std::move(job));
  }
  specialise({jobs.begin(), jobs.end()}, results, options);
}

}  // namespace rg::compiler
