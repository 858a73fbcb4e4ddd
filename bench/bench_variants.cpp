// 256 variants of one shader: against both libraries called once a variant, and against the command-line tools; the cache on the frame.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "bench/rows.h"
#include "compiler/compile.h"
#include "compiler/shaders/glslang_front_end.h"
#include "compiler/shaders/interface.h"
#include "compiler/shaders/shader_jobs.h"
#include "compiler/shaders/statistics.h"
#include "compiler/variant_space.h"
#include "dsl/front_end.h"

namespace rg::bench {
namespace {

namespace fs = std::filesystem;
using namespace compiler;

constexpr const char* kShader = "bench/shaders/uber.rg";
constexpr size_t kVariants = 256, kSampled = 16;

std::optional<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(file), {}};
}
dsl::ReadSource reader() {
  return [](const std::string& path, std::string& why) {
    auto text = read_text(path);
    if (!text) why = "no such file";
    return text;
  };
}

struct Uber {
  dsl::Program program;
  dsl::SourceFiles files;
  std::string text;
};
std::optional<Uber> load_uber() {
  dsl::Diagnostics diagnostics;
  dsl::FrontEndResult front = dsl::load_program(kShader, reader(), diagnostics);
  auto text = read_text("bench/shaders/uber.comp");
  if (diagnostics.has_errors() || !text) return std::nullopt;
  Uber uber{std::move(front.program), std::move(front.files), std::move(*text)};
  return uber;
}
const dsl::Pass& shade_pass(const Uber& uber) {
  for (const dsl::Pass& pass : uber.program.graphs.rows[0].passes)
    if (pass.name == "shade") return pass;
  std::abort();
}

// The interface with every feature a plain constant: what a build without specialisation compiles.
std::string plain_prelude(const Uber& uber, size_t variant) {
  FixedFeatures fixed;
  const dsl::Pass& pass = shade_pass(uber);
  for (size_t i = 0; i < pass.features.size(); ++i) fixed.push_back(variant >> (pass.features.size() - 1 - i) & 1);
  return text(make_prelude(uber.program, uber.program.graphs.rows[0], pass, dsl::stage_compute, fixed));
}

Words plain_variant(const Uber& uber, size_t variant, ShaderSources& sources) {
  return optimise_spirv(compile_glsl(dsl::stage_compute, plain_prelude(uber, variant), "uber.comp", uber.text, sources).words);
}

// Milliseconds of a variant by the two tools, in processes of their own.
double command_line_ms(const Uber& uber) {
  const fs::path folder = fs::temp_directory_path() / ("rgc_bench_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  for (size_t i = 0; i < kSampled; ++i)
    std::ofstream(folder / (std::to_string(i) + ".comp")) << plain_prelude(uber, i * kVariants / kSampled) << uber.text;
  const std::string base = folder.string() + "/$i";
  const std::string script = "for i in $(seq 0 " + std::to_string(kSampled - 1) +
                             "); do glslangValidator -V --target-env vulkan1.3 --target-env spirv1.5 " + base + ".comp -o " + base +
                             ".spv >/dev/null && spirv-opt -O " + base + ".spv -o " + base + ".opt.spv || exit 1; done";
  bool good = true;
  const double ms = cpu_ms([&] { good = std::system(script.c_str()) == 0; });
  fs::remove_all(folder);
  return good ? ms / kSampled : 0;
}

ShaderBundle build_all(Uber& uber, unsigned workers) {
  dsl::Diagnostics diagnostics;
  const dsl::GraphId graph{size_t{0}};
  const auto configurations = expand_configurations(uber.program, graph, {}, 64, diagnostics);
  const VariantSpace space = find_variant_space(uber.program, graph, configurations, diagnostics);
  const ReadFile read = [](const std::string& path, std::string&) { return read_text("bench/shaders/" + path); };
  return compile_shaders(uber.program, graph, space, read, uber.files, {nullptr, workers, {}}, diagnostics);
}

Rows variant_rows() {
  auto uber = load_uber();
  if (!uber) return {};
  ShaderSources sources([](const std::string&, std::string&) { return std::nullopt; });
  uint64_t plain_instructions = 0, our_instructions = 0;
  plain_variant(*uber, 0, sources);  // glslang's tables are built once a process
  std::vector<Words> plain(kSampled);
  const double libraries = median_cpu_ms(3,
                                         [&] {
                                           for (size_t i = 0; i < kSampled; ++i) plain[i] = plain_variant(*uber, i * kVariants / kSampled, sources);
                                         }) /
                           kSampled;
  for (const Words& words : plain) plain_instructions += find_statistics(words).instructions;
  ShaderBundle bundle;
  const double one = median_cpu_ms(3, [&] { bundle = build_all(*uber, 1); }) / kVariants;
  const double one_wall = median_ms(3, [&] { bundle = build_all(*uber, 1); }) / kVariants;
  const double all = median_ms(3, [&] { bundle = build_all(*uber, 0); }) / kVariants;
  for (const PassShaders& pass : bundle.passes)
    for (size_t i = 0; i < kSampled && !pass.variants.empty() && pass.variants[0].size() == kVariants; ++i)
      our_instructions += find_statistics(bundle.shaders[pass.variants[0][i * kVariants / kSampled][0]].words).instructions;
  const double tools = command_line_ms(*uber);
  Rows rows = {
      {"variants/uber/one_core", one, "ms", libraries, "glslang and -O in process, each variant"},
      {"variants/uber/all_cores", all, "ms", one_wall, "one core, both by the clock"},
      {"variants/uber/instructions", static_cast<double>(our_instructions), "count", static_cast<double>(plain_instructions), "-O of each variant"}};
  if (tools > 0) rows.push_back({"variants/uber/against_tools", one, "ms", tools, "glslangValidator and spirv-opt -O, a process each"});
  return rows;
}

// Each step of all variants by itself, on one core.
struct Steps {
  double parse = 0, optimise = 0, specialise = 0, deduplicate = 0, finish = 0, validate = 0;  // milliseconds
  size_t distinct = 0;
  double total() const { return parse + optimise + specialise + deduplicate + finish + validate; }
};
Steps time_steps(const Uber& uber) {
  ShaderSources sources([](const std::string&, std::string&) { return std::nullopt; });
  const std::string prelude = text(make_prelude(uber.program, uber.program.graphs.rows[0], shade_pass(uber), dsl::stage_compute));
  Steps steps;
  Words written, generic;
  steps.parse = median_cpu_ms(3, [&] { written = compile_glsl(dsl::stage_compute, prelude, "uber.comp", uber.text, sources).words; });
  steps.optimise = median_cpu_ms(3, [&] { generic = optimise_spirv(written); });
  std::vector<Words> pruned(kVariants), finished;
  steps.specialise = cpu_ms([&] {
    for (size_t v = 0; v < kVariants; ++v) {
      ConstantValues values;
      for (uint32_t i = 0; i < 8; ++i) values.emplace_back(kFirstFeatureConstant + i, v >> i & 1);
      pruned[v] = prune_spirv(set_constants(generic, values));
    }
  });
  std::map<Words, size_t> distinct;
  steps.deduplicate = cpu_ms([&] {
    for (size_t v = 0; v < kVariants; ++v) distinct.try_emplace(pruned[v], v);
  });
  steps.finish = cpu_ms([&] {
    for (const auto& [words, first] : distinct) finished.push_back(finish_spirv(words));
  });
  steps.validate = cpu_ms([&] {
    for (const Words& words : finished) static_cast<void>(validate_spirv(words));
  });
  steps.distinct = distinct.size();
  return steps;
}

// Where the time goes, and the share of variants that are found to be others.
Rows share_rows() {
  auto uber = load_uber();
  if (!uber) return {};
  const Steps steps = time_steps(*uber);
  const double hundredth = steps.total() / 100;
  Rows rows = {{"variants/uber/total", steps.total(), "ms", {}, "all steps of all variants, one core"}};
  const std::pair<const char*, double> shares[] = {{"parse_once", steps.parse},      {"optimise_once", steps.optimise},
                                                   {"specialise", steps.specialise}, {"deduplicate", steps.deduplicate},
                                                   {"finish", steps.finish},         {"validate", steps.validate}};
  for (const auto& [name, ms] : shares) rows.push_back({std::string("variants/uber/share/") + name, ms / hundredth, "%", {}, ""});
  rows.push_back(
      {"variants/uber/duplicates", 100.0 * static_cast<double>(kVariants - steps.distinct) / kVariants, "%", {}, "variants equal to another"});
  return rows;
}

double build_frame_ms(const std::string& cache, const dsl::ReadSource& read) {
  return median_cpu_ms(5, [&] {
    dsl::Diagnostics diagnostics;
    CompileOptions options;
    options.cache_folder = cache;
    (void)compile("passes.rg", read, options, diagnostics);
  });
}

// The frame with everything in the cache, and with one shader edited anew each time.
Rows cache_rows() {
  if (!read_text("passes.rg")) return {};
  const fs::path folder = fs::temp_directory_path() / ("rgc_bench_cache_" + std::to_string(::getpid()));
  int edits = 0;
  const dsl::ReadSource edited = [&](const std::string& path, std::string& why) {
    auto text = reader()(path, why);
    if (text && path.ends_with("deferred_light.comp")) *text += "// " + std::to_string(++edits) + "\n";
    return text;
  };
  const double cold = build_frame_ms("", reader());
  const double warm = build_frame_ms(folder, reader()), edit = build_frame_ms(folder, edited);
  fs::remove_all(folder);
  return {{"variants/frame/no_change", warm, "ms", cold, "without a cache"},
          {"variants/frame/one_shader_edited", edit, "ms", cold, "without a cache"}};
}

// What `rgc watch` does after an edit of the lighting's kernels: the preview, and the whole build behind it.
Rows preview_rows() {
  if (!read_text("passes.rg")) return {};
  const fs::path folder = fs::temp_directory_path() / ("rgc_bench_preview_" + std::to_string(::getpid()));
  int edits = 0;
  const dsl::ReadSource edited = [&](const std::string& path, std::string& why) {
    constexpr std::string_view kPlace = "0.25 * sum";
    auto text = reader()(path, why);
    const size_t at = text && path.ends_with("deferred_light.comp") ? text->find(kPlace) : std::string::npos;
    if (at != std::string::npos) text->replace(at, kPlace.size(), "(0.25 + 0.001 * " + std::to_string(edits) + ".0) * sum");
    return text;
  };
  CompileOptions options;
  options.cache_folder = folder;
  options.until = Until::plans;
  dsl::Diagnostics diagnostics;
  const CompileResult before = compile("passes.rg", edited, options, diagnostics);
  std::vector<double> previews, wholes;
  for (int round = 0; round < 5; ++round) {
    ++edits;
    options.preview = true, options.earlier = &before.spectra;
    previews.push_back(once_ms([&] { (void)compile("passes.rg", edited, options, diagnostics); }));
    options.preview = false, options.earlier = nullptr;
    wholes.push_back(once_ms([&] { (void)compile("passes.rg", edited, options, diagnostics); }));
  }
  fs::remove_all(folder);
  std::sort(previews.begin(), previews.end()), std::sort(wholes.begin(), wholes.end());
  return {{"variants/frame/preview", previews[2], "ms", wholes[2], "the whole build after that edit, both by the clock"}};
}

}  // namespace

Rows bench_variants(const std::string&) {
  Rows rows = variant_rows();
  for (const Rows& more : {share_rows(), cache_rows(), preview_rows()}) rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace rg::bench
