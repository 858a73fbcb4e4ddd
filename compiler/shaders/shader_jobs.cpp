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

// A key says what is done to which words: sources that compile to the same words share everything that comes after.
Digest key_of(std::string_view what, const Words& words) {
  return Sha256()
      .add_part(tool_versions())
      .add_part(what)
      .add_part({reinterpret_cast<const char*>(words.data()), words.size() * sizeof(uint32_t)})
      .finish();
}

Digest key_of(const FrontEndResult& front_end, const ConstantValues& values) {
  Sha256 hash;
  hash.add_part(hex(front_end.key)).add_number(values.size());
  for (const auto& [number, value] : values) hash.add_number(number).add_number(value);
  return hash.finish();
}

FrontEndResult from_modules(const Words& written, Words generic, const ShaderCache* cache) {
  FrontEndResult result;
  result.reflection = reflect(written);
  result.uses = find_uses(generic);
  result.numbers = specialisation_ids(generic);
  if (cache != nullptr) result.key = key_of("specialise", generic);
  result.generic = std::move(generic);
  return result;
}

std::optional<Words> kept(const ShaderCache* cache, std::string_view what, const Words& of) {
  if (cache == nullptr) return std::nullopt;
  auto found = cache->find(key_of(what, of));
  return found && found->size() == 1 ? std::optional(std::move((*found)[0])) : std::nullopt;
}
void keep(const ShaderCache* cache, std::string_view what, const Words& of, const Words& result) {
  if (cache != nullptr) cache->store(key_of(what, of), {result});
}

// Enough to see what is used; what it leaves to do, drivers do for engines that optimise nothing.
FrontEndResult in_a_hurry(const Words& written) {
  FrontEndResult result = from_modules(written, inline_spirv(written), nullptr);
  result.hurried = true;
  return result;
}

FrontEndResult run_front_end(const FrontEndJob& job, ShaderSources& sources, const ShaderOptions& options) {
  const ShaderCache* cache = options.cache;
  const Digest key = cache != nullptr ? key_of(job) : Digest{};
  if (cache != nullptr)
    if (auto found = cache->find(key); found && found->size() == 2) return from_modules((*found)[0], std::move((*found)[1]), cache);
  FrontEndOutput written = compile_glsl(job.stage, job.prelude, job.path, *job.text, sources);
  FrontEndResult failed;
  failed.errors = std::move(written.errors);
  if (!failed.errors.empty()) return failed;
  auto generic = kept(cache, "optimise", written.words);  // only what is valid is kept
  if (!generic) {
    const std::string problem = validate_spirv(written.words);
    if (!problem.empty()) {
      failed.errors.push_back({job.path, 1, "SPIR-V is not valid: " + problem});
      return failed;
    }
    if (options.effort == ShaderEffort::preview && job.kernels) return in_a_hurry(written.words);
    generic = optimise_spirv(written.words);
    keep(cache, "optimise", written.words, *generic);
  }
  if (cache != nullptr) cache->store(key, {written.words, *generic});
  return from_modules(written.words, std::move(*generic), cache);
}

// ---- specialisation

struct Variant {
  Words words;  // pruned, or, if `done`, final
  bool done = false;
  bool valid = false;  // its final words passed the validator
  bool kept = false;   // as it is
  Digest key;
};

// In the cache: the words, and whether they have been validated.
Variant prune(const SpecialiseJob& job, const FrontEndResult& front_end, const ShaderCache* cache) {
  Variant result;
  if (front_end.hurried) {
    result.words = without_names(set_constants(front_end.generic, job.values));
    return result;
  }
  if (cache != nullptr) {
    result.key = key_of(front_end, job.values);
    if (auto found = cache->find(result.key); found && found->size() == 2 && (*found)[1].size() == 1) {
      result.words = std::move((*found)[0]);
      result.done = result.kept = true;
      result.valid = (*found)[1][0] != 0;
      return result;
    }
  }
  result.done = front_end.numbers.empty();
  result.words = result.done ? strip_spirv(front_end.generic) : prune_spirv(set_constants(front_end.generic, job.values));
  return result;
}

Words finish(const Words& pruned, const ShaderCache* cache) {
  if (auto found = kept(cache, "finish", pruned)) return std::move(*found);
  Words words = finish_spirv(pruned);
  keep(cache, "finish", pruned, words);
  return words;
}

void validate(Variant& variant) {
  RG_CHECK(validate_spirv(variant.words).empty(), "specialised SPIR-V is not valid");
  variant.valid = true, variant.kept = false;
}

// Brings every variant to its final words; equal pruned ones share the work.
void finish_all(std::vector<Variant>& variants, const ShaderOptions& options) {
  std::map<Words, size_t> first;
  std::vector<size_t> distinct, row(variants.size());
  for (size_t i = 0; i < variants.size(); ++i) {
    if (variants[i].done) continue;
    const auto [at, is_new] = first.try_emplace(variants[i].words, distinct.size());
    if (is_new) distinct.push_back(i);
    row[i] = at->second;
  }
  std::vector<Words> finished(distinct.size());
  for_each_parallel(distinct.size(), options.workers, {"distinct variant", distinct.size(), options.progress},
                    [&](size_t i) { finished[i] = finish(variants[distinct[i]].words, options.cache); });
  for (size_t i = 0; i < variants.size(); ++i)
    if (!variants[i].done) variants[i].words = finished[row[i]], variants[i].done = true;
}

// One of those with equal words for all. What is not done is not final.
void validate_all(std::vector<Variant>& variants, const ShaderOptions& options) {
  std::map<Words, std::vector<size_t>> open;
  for (size_t i = 0; i < variants.size(); ++i)
    if (variants[i].done && !variants[i].valid) open[variants[i].words].push_back(i);
  std::vector<const std::vector<size_t>*> rows;
  for (const auto& [words, equal] : open) rows.push_back(&equal);
  for_each_parallel(rows.size(), options.workers, {"valid variant", rows.size(), options.progress},
                    [&](size_t i) { validate(variants[rows[i]->front()]); });
  for (const std::vector<size_t>* equal : rows)
    for (const size_t i : *equal) variants[i].valid = true, variants[i].kept = false;
}

}  // namespace

std::vector<FrontEndResult> run_front_ends(const std::vector<FrontEndJob>& jobs, ShaderSources& sources, const ShaderOptions& options) {
  std::vector<FrontEndResult> results(jobs.size());
  for_each_parallel(jobs.size(), options.workers, {"shader", jobs.size(), options.progress},
                    [&](size_t i) { results[i] = run_front_end(jobs[i], sources, options); });
  return results;
}

Digest digest_of_variants(const dsl::Program& program, dsl::GraphId graph, const VariantSpace& space, const ReadFile& read) {
  ShaderSources sources(read);
  dsl::Diagnostics ignored;
  const ShaderWork work = collect_work(program, program.graphs[graph], space, sources, ignored);
  Sha256 hash;
  for (size_t p = 0; p < work.passes.size(); ++p) {
    for (const ShaderUse& use : work.passes[p])
      for (const size_t job : use.jobs) hash.add_part(hex(key_of(work.jobs[job])));
    for (const VariantRow& row : space.passes[p])
      for (const uint32_t value : row.values) hash.add_number(value);
    hash.add_number(p);
  }
  return hash.finish();
}

Specialised specialise(const std::vector<SpecialiseJob>& jobs, const std::vector<FrontEndResult>& front_ends, const ShaderOptions& options) {
  std::vector<Variant> variants(jobs.size());
  for_each_parallel(jobs.size(), options.workers, {"shader variant", jobs.size(), options.progress},
                    [&](size_t i) { variants[i] = prune(jobs[i], front_ends[jobs[i].front_end], options.cache); });
  if (options.effort != ShaderEffort::preview) finish_all(variants, options);
  if (options.effort != ShaderEffort::measure) validate_all(variants, options);
  Specialised results;
  for (Variant& variant : variants) {
    results.complete = results.complete && variant.done;
    if (variant.done && !variant.kept && options.cache != nullptr) options.cache->store(variant.key, {variant.words, {uint32_t{variant.valid}}});
    results.words.push_back(std::move(variant.words));
  }
  return results;
}

}  // namespace rg::compiler
