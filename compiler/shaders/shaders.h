// Shaders of a graph: GLSL behind a generated interface -> SPIR-V, reflected and compared with the declaration.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

// How the compiler reads shader sources; `path` is relative to the root file's folder and never leaves it. Nothing, and `why`, where it cannot.
using ReadFile = std::function<std::optional<std::string>(const std::string& path, std::string& why)>;

// One selection of a pass's features. A pass has a row for every combination that some feature configuration of the graph leaves open to it.
struct VariantRow {
  uint32_t configuration = 0;    // of the graph: which plan
  uint32_t selector = 0;         // which of that plan's combinations of features that no plan depends on, in counting order
  bool live = true;              // something observable depends on the pass there
  std::vector<uint32_t> values;  // by Pass::features
  friend bool operator==(const VariantRow&, const VariantRow&) = default;
};
// Which shaders the plans of a graph can select: rows by PassId, ascending by configuration and selector; none where a configuration lacks the pass.
struct VariantSpace {
  uint32_t configurations = 1;
  std::vector<std::vector<VariantRow>> passes;
  std::vector<std::vector<std::vector<size_t>>> selecting;  // by PassId and configuration: the features that make the selector
};
// Every feature at its initial value, every pass live.
VariantSpace initial_variants(const dsl::Program& program, dsl::GraphId graph);

struct CompiledShader {
  std::string name;  // "culling/light_cull.comp", made unique per interface by a suffix where needed
  dsl::Stage stage = dsl::stage_compute;
  std::vector<uint32_t> words;  // validated, optimised, stripped SPIR-V 1.5
  uint32_t shared_bytes = 0;    // of workgroup memory, see statistics.h
};
struct PassShaders {
  std::vector<size_t> shaders;                             // indices of ShaderBundle::shaders, in stage order, of the first live row
  std::vector<std::vector<std::vector<size_t>>> variants;  // the same by configuration and selector; empty where there is no live row
  std::vector<std::vector<std::vector<uint32_t>>> values;  // of Pass::features, by configuration and selector, beside `variants`
  std::vector<std::vector<size_t>> selecting;              // by configuration: the features that make the selector, indices into Pass::features
  std::vector<uint32_t> access_stages;                     // Stage bits per Pass::accesses: who really uses it; 0: not a shader access
  std::vector<uint32_t> params_stages;                     // Stage bits per Pass::params
  uint32_t push_stages = 0;
};

// What became of the variants of one shader of one pass. `declared` combinations of its features' values, less
//   `infeasible`   no plan has them        `unreachable`  the pass is absent or culled in every plan that has them
//   `indifferent`  they differ only in features the shader does not look at
//   `equal`        they turned out as the same SPIR-V as another
// leaves `built`.
struct VariantCount {
  std::string pass, shader;
  uint64_t declared = 1, infeasible = 0, unreachable = 0, indifferent = 0, equal = 0, built = 1;
  uint64_t front_ends = 1;  // runs of the front end: one a distinct preprocessor key
  friend bool operator==(const VariantCount&, const VariantCount&) = default;
};
struct ShaderBundle {
  std::vector<CompiledShader> shaders;  // equal SPIR-V stored once
  std::vector<PassShaders> passes;      // indexed by PassId
  std::vector<VariantCount> counts;     // of shaders with features
  std::vector<std::string> read_files;  // for the depfile
  bool complete = true;                 // false: a preview left work undone
};

// One variant of one shader: what a machine can build by itself, given the sources.
struct ShaderTask {
  std::string pass, shader, features;  // "fog=on, path=low"
  friend bool operator==(const ShaderTask&, const ShaderTask&) = default;
};

class ShaderCache;
enum class ShaderEffort : uint8_t {
  product,
  measure,  // the shaders are measured and thrown away: nobody validates them
  preview,  // somebody waits: variants that are not in the cache have their constants set and lack what those leave out, and that is all. Their
            // module is valid and optimised, but kernels of a spectrum are neither optimised nor pruned. ShaderBundle::complete says whether that
            // came to anything
};
struct ShaderOptions {
  const ShaderCache* cache = nullptr;  // see cache.h; null: none
  unsigned workers = 0;                // 0: one a core
  std::function<void(std::string_view)> progress;
  ShaderEffort effort = ShaderEffort::product;
};

// The variants of `graph`, each once, in an order that only the sources decide.
std::vector<ShaderTask> list_tasks(const dsl::Program& program, dsl::GraphId graph, const VariantSpace& space, const ReadFile& read,
                                   dsl::Diagnostics& diagnostics);
// Builds every task whose number modulo `shards` is `shard` into the cache, and nothing else. What compile_shaders finds there afterwards gives
// the same bundle as without shards. Reports what does not compile.
void build_shard(const dsl::Program& program, dsl::GraphId graph, const VariantSpace& space, const ReadFile& read, dsl::SourceFiles& files,
                 const ShaderOptions& options, unsigned shard, unsigned shards, dsl::Diagnostics& diagnostics);

// Compiles every shader of `graph` and compares it with its pass. Undeclared, unused and contradicting accesses are reported at the
// declaration and at the shader line; the shader texts a diagnostic points into are added to `files`.
//
// One front-end run a distinct (path, interface, values of features that preprocessor lines name); all other features are specialisation
// constants of its module, set to the values of each live configuration, then folded, stripped and stored once where equal.
// `read` is called from one thread at a time. Same input, same bundle, whatever the cache and the workers do. After an error the bundle must not be
// used.
ShaderBundle compile_shaders(const dsl::Program& program, dsl::GraphId graph, const VariantSpace& space, const ReadFile& read,
                             dsl::SourceFiles& files, const ShaderOptions& options, dsl::Diagnostics& diagnostics);

// The program with every Access::stages of `graph` filled from the shaders.
dsl::Program resolve_stages(dsl::Program program, dsl::GraphId graph, const ShaderBundle& bundle);

}  // namespace rg::compiler
