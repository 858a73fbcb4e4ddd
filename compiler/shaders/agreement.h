// Does a shader do what its pass declares? Findings are reported at the declaration and at the shader line.
#pragma once

#include <string>
#include <vector>

#include "compiler/shaders/glslang_front_end.h"
#include "compiler/shaders/reflect.h"
#include "compiler/shaders/spirv_uses.h"
#include "dsl/diagnostics.h"

namespace rg::compiler {

// A shader of a pass, compiled. `path` is relative to the root folder.
struct StageOutput {
  dsl::Stage stage = dsl::stage_compute;
  std::string path;
  dsl::Span span;         // of the `shader` statement
  Reflection reflection;  // of the module as written
  ModuleUses uses;        // of the optimised module
};

// Adds shader texts to the source files when a diagnostic needs a place in them.
class ShaderPlaces {
 public:
  ShaderPlaces(dsl::SourceFiles& files, ShaderSources& sources);
  dsl::Span line(const std::string& path, uint32_t line);
  // First use of `name` as a whole word outside comments; the whole first line where there is none.
  dsl::Span word(const std::string& path, const std::string& name);
  // The word in that line, or the line.
  dsl::Span word_in_line(const std::string& path, uint32_t line, const std::string& name);
  std::string text_of_line(const std::string& path, uint32_t line);

 private:
  dsl::FileId file(const std::string& path);
  dsl::SourceFiles& files_;
  ShaderSources& sources_;
  std::string root_folder_;
};

struct PassContext {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const dsl::Pass& pass;
};

// A message of glslang becomes the diagnostic it stands for.
void report_message(const PassContext& context, const dsl::Shader& shader, const Prelude& prelude, const ShaderMessage& message, ShaderPlaces& places,
                    dsl::Diagnostics& diagnostics);
// Unused, contradicting, undeclared accesses and outputs of a pass whose shaders all compile.
void check_agreement(const PassContext& context, const std::vector<StageOutput>& stages, ShaderPlaces& places, dsl::Diagnostics& diagnostics);
// Which stages must not be missing; before anything is compiled.
void check_stages(const dsl::Pass& pass, dsl::Diagnostics& diagnostics);
std::string stage_name(dsl::Stage stage);

}  // namespace rg::compiler
