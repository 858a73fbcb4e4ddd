#include "compiler/shaders/shader_jobs.h"

#include <algorithm>

#include "compiler/shaders/parallel.h"
#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

Digest key_of(const FrontEndJob& job) {
  Sha256 hash;
  hash.add_part(tool_versions()).add_number(job.stage).add_part(job.prelude).add_number(job.closure.size());
  for (const SourceText& source : job.closure) {
    hash.add_part(source.path).add_number(source.text != nullptr);
    if (source.text != nullptr) hash.add_part(*source.text);
  }
  return hash.finish();
}

Digest key_of(const FrontEndResult& front_end, const ConstantValues& values) {
  Sha256 hash;
  hash.add_part(hex(front_end.key)).add_number(values.size());
  for (const auto& [number, value] : values) hash.add_number(number).add_number(value);
  return hash.finish();
}

FrontEndResult from_modules(const Words& written, Words generic, const Digest& key) {
  FrontEndResult result;
  result.reflection = reflect(written);
  result.uses = find_uses(generic);
  result.numbers = specialisation_ids(generic);
  result.generic = std::move(generic);
  result.key = key;
  return result;
}

FrontEndResult run_front_end(const FrontEndJob& job, ShaderSources& sources, const ShaderCache* cache) {
  const Digest key = cache != nullptr ? key_of(job) : Digest{};
  if (cache != nullptr)
    if (auto found = cache->find(key); found && found->size() == 2) return from_modules((*found)[0], std::move((*found)[1]), key);
  FrontEndOutput written = compile_glsl(job.stage, job.prelude, job.path, *job.text, sources);
  FrontEndResult failed;
  failed.errors = std::move(written.errors);
  if (!failed.errors.empty()) return failed;
  const std::string problem = validate_spirv(written.words);
  if (!problem.empty()) {
    failed.errors.push_back({job.path, 1, "SPIR-V is not valid: " + problem});
    return failed;
  }
  Words generic = optimise_spirv(written.words);
  if (cache != nullptr) cache->store(key, {written.words, generic});
  return from_modules(written.words, std::move(generic), key);
}

// ---- specialisation

struct Pruned {
  Words words;  // pruned, or, if `done`, final
  bool done = false;
  Digest key;
};

Pruned prune(const SpecialiseJob& job, const FrontEndResult& front_end, const ShaderCache* cache) {
  Pruned result;
  if (cache != nullptr) {
    result.key = key_of(front_end, job.values);
    if (auto found = cache->find(result.key); found && found->size() == 1) {
      result.words = std::move((*found)[0]);
      result.done = true;
      return result;
    }
  }
  result.done = front_end.numbers.empty();
  result.words = result.done ? strip_spirv(front_end.generic) : prune_spirv(set_constants(front_end.generic, job.values));
  if (!result.done) return result;
  RG_CHECK(validate_spirv(result.words).empty(), "optimised SPIR-V is not valid");
  if (cache != nullptr) cache->store(result.key, {result.words});
  return result;
}

Words finish(const Words& pruned) {
  Words words = finish_spirv(pruned);
  RG_CHECK(validate_spirv(words).empty(), "specialised SPIR-V is not valid");
  return words;
}

}  // namespace

std::vector<FrontEndResult> run_front_ends(const std::vector<FrontEndJob>& jobs, ShaderSources& sources, const ShaderOptions& options) {
  std::vector<FrontEndResult> results(jobs.size());
  for_each_parallel(jobs.size(), options.workers, {"shader", jobs.size(), options.progress},
                    [&](size_t i) { results[i] = run_front_end(jobs[i], sources, options.cache); });
  return results;
}

std::vector<Words> specialise(const std::vector<SpecialiseJob>& jobs, const std::vector<FrontEndResult>& front_ends, const ShaderOptions& options) {
  std::vector<Pruned> pruned(jobs.size());
  for_each_parallel(jobs.size(), options.workers, {"shader variant", jobs.size(), options.progress},
                    [&](size_t i) { pruned[i] = prune(jobs[i], front_ends[jobs[i].front_end], options.cache); });

  std::map<Words, size_t> first;  // of equal pruned modules
  std::vector<size_t> distinct, row(jobs.size());
  for (size_t i = 0; i < jobs.size(); ++i) {
    if (pruned[i].done) continue;
    const auto [at, is_new] = first.try_emplace(pruned[i].words, distinct.size());
    if (is_new) distinct.push_back(i);
    row[i] = at->second;
  }
  std::vector<Words> finished(distinct.size());
  for_each_parallel(distinct.size(), options.workers, {"distinct variant", distinct.size(), options.progress},
                    [&](size_t i) { finished[i] = finish(pruned[distinct[i]].words); });

  std::vector<Words> results(jobs.size());
  for (size_t i = 0; i < jobs.size(); ++i) {
    results[i] = pruned[i].done ? std::move(pruned[i].words) : finished[row[i]];
    if (!pruned[i].done && options.cache != nullptr) options.cache->store(pruned[i].key, {results[i]});
  }
  return results;
}

}  // namespace rg::compiler
