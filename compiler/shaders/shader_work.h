// What there is to do for the shaders of a graph: front-end runs, each done once however many passes and configurations need it.
#pragma once

#include <vector>

#include "compiler/shaders/agreement.h"
#include "compiler/shaders/variants.h"

namespace rg::compiler {

// One distinct (path, stage, interface with preprocessor key); loop instances of a pass usually share theirs.
struct FrontEndJob {
  dsl::Stage stage = dsl::stage_compute;
  std::string path;
  std::string prelude;
  const std::string* text = nullptr;
  std::vector<SourceText> closure;  // the text and what it includes
  bool kernels = false;             // of a spectrum: all there are run on one device, whatever their features
};
// One shader of one pass.
struct ShaderUse {
  dsl::Shader shader;
  std::string path;                 // resolved
  std::vector<FixedFeatures> keys;  // by row of the pass
  std::vector<size_t> jobs;         // by row: of ShaderWork::jobs
};
struct ShaderWork {
  std::vector<FrontEndJob> jobs;
  std::vector<std::vector<ShaderUse>> passes;  // by PassId, in stage order; empty: no shaders, or one could not be read
};

// Reports shaders that cannot be read and stages that are missing. The texts belong to `sources` and `program`.
ShaderWork collect_work(const dsl::Program& program, const dsl::Graph& graph, const VariantSpace& space, ShaderSources& sources,
                        dsl::Diagnostics& diagnostics);
bool is_generated_fullscreen(const ShaderUse& use);

}  // namespace rg::compiler
