// The whole compiler as one function. compile.cpp is its table of contents.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/codegen/generate.h"
#include "compiler/plan_frame.h"
#include "compiler/shaders/shaders.h"
#include "dsl/diagnostics.h"
#include "dsl/front_end.h"

namespace rg::compiler {

enum class Until : uint8_t { program, shaders, plans, files };

struct CompileOptions {
  Until until = Until::files;
  PlanOptions plan;
  std::string profile, profile_text;               // a file of measured times, see compiler/pass_cost.h, and what is in it; empty: none
  std::vector<std::string> fixed_features;         // `-D fog=off`: static features, each "NAME=VALUE"
  size_t max_plans = 64;                           // feature configurations of one graph
  std::string command;                             // as it shall stand in the banner of generated files
  std::function<void(std::string_view)> progress;  // what is being worked on, for a person; may be empty
};

// One graph: its shaders, and a plan for each feature configuration.
struct CompiledGraph {
  dsl::GraphId graph;
  ShaderBundle shaders;
  std::vector<FramePlan> plans;
};

struct CompileResult {
  dsl::SourceFiles sources;             // sources[0] is the root file; diagnostics point into them
  dsl::Program program;                 // every Access::stages resolved, from Until::shaders on
  std::vector<CompiledGraph> graphs;    // in order of declaration
  std::vector<GeneratedFile> files;     // paths relative to the output folder
  std::vector<std::string> read_files;  // sources and shader files, for a depfile
};

// Reads `root_path` and everything it names. After an error was reported the later tables are empty.
CompileResult compile(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
