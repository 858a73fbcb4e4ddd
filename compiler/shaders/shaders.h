// Shaders of a graph: GLSL behind a generated interface -> SPIR-V, reflected and compared with the declaration.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

// How the compiler reads shader sources; `path` is relative to the root file's folder and never leaves it.
using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;

struct CompiledShader {
  std::string name;  // "culling/light_cull.comp", made unique per interface by a suffix where needed
  dsl::Stage stage = dsl::stage_compute;
  std::vector<uint32_t> words;  // validated, optimised, stripped SPIR-V 1.5
};
struct PassShaders {
  std::vector<size_t> shaders;          // indices of ShaderBundle::shaders, in stage order
  std::vector<uint32_t> access_stages;  // Stage bits per Pass::accesses: who really uses it; 0: not a shader access
  std::vector<uint32_t> params_stages;  // Stage bits per Pass::params
  uint32_t push_stages = 0;
};
struct ShaderBundle {
  std::vector<CompiledShader> shaders;  // equal SPIR-V stored once
  std::vector<PassShaders> passes;      // indexed by PassId
  std::vector<std::string> read_files;  // for the depfile
};

// Compiles every shader of `graph` and compares it with its pass. Undeclared, unused and contradicting accesses are reported at the
// declaration and at the shader line; the shader texts a diagnostic points into are added to `files`.
// `read` is called from one thread at a time. Same input, same bundle. After an error the bundle must not be used.
ShaderBundle compile_shaders(const dsl::Program& program, dsl::GraphId graph, const ReadFile& read, dsl::SourceFiles& files,
                             dsl::Diagnostics& diagnostics);

// The program with every Access::stages of `graph` filled from the shaders.
dsl::Program resolve_stages(dsl::Program program, dsl::GraphId graph, const ShaderBundle& bundle);

}  // namespace rg::compiler
