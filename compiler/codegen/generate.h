// Program, plans and SPIR-V as the files an engine compiles: typed header, plan tables, shader words.
#pragma once

#include <string>
#include <vector>

#include "compiler/plan_frame.h"
#include "compiler/shaders/shaders.h"
#include "dsl/program.h"
#include "dsl/source.h"

namespace rg::compiler {

struct GeneratedFile {
  std::string path;  // relative to the output folder, except where said otherwise
  std::string text;
};

// One graph with a plan for each feature configuration; every plan went through attach_shaders().
struct GraphOutput {
  dsl::GraphId graph;
  const std::vector<FramePlan>* plans = nullptr;
};

// `command` is what the banner tells the reader to run, "./x gen". The same input gives the same bytes; nothing holds a time or a machine's path.
//
//   <module>.h           structs, Extents, Imports, Params, the recorder concept, class Frame; see docs/generated.md
//   <module>_plan.cpp    the plan as constexpr tables, and the few functions of the API that are not inline; one file a plan
//   shaders/*.spv.h      SPIR-V words
//   README.md, CMakeLists.txt (library rgc_frame)
std::vector<GeneratedFile> generate(const dsl::Program& program, const std::vector<GraphOutput>& graphs, const dsl::SourceFiles& files,
                                    const std::string& command);

}  // namespace rg::compiler
