// What the typed API of a graph consists of, collected from its plan before any text is written.
#pragma once

#include <string>
#include <vector>

#include "compiler/codegen/emit_structs.h"
#include "compiler/codegen/plan_values.h"
#include "compiler/plan_frame.h"

namespace rg::compiler {

inline constexpr std::string_view kUnusedImport = "rg::Unused<";  // begins the type of an import that the plan does without

struct ApiMember {  // of Imports, Params, Updates, Conditions, EngineSets: by slot
  std::string name, type, comment;
};
struct ApiExtent {
  std::string name;
  uint32_t axes = 2;
  int64_t initial[3] = {1, 1, 1};
};
struct ApiPass {                                 // recorded by the host; by host slot
  std::string method, type, push_type, comment;  // push_type empty: no push constants
  uint32_t push_stages = 0;
  bool raster = false, compute = false;
};
struct ApiFeature {  // that shaders are chosen by, or passes run by; without values: a bool
  std::string name, type;
  std::vector<std::string> values;
  uint32_t initial = 0;
  std::string comment;
};
struct ApiReadback {
  std::string name, resource, element, comment;
};
struct FrameApi {
  std::string scope;       // namespace, "frame" or "frame::shadows"
  std::string class_name;  // "Frame"
  PlanNames names;
  std::vector<ApiExtent> extents;
  std::vector<ApiMember> imports, params, updates, conditions, engine_sets;
  std::vector<std::string> condition_bits;  // by bit: the member or element of Conditions, `cache_miss[3]`; empty: it follows from a feature
  std::vector<std::string> feature_values;  // by row of Plan::features: its value as an expression
  std::vector<ApiFeature> features;         // by index of Plan::features
  std::vector<ApiPass> passes;
  std::vector<ApiReadback> readbacks;
};
FrameApi collect_api(const dsl::Program& program, dsl::GraphId graph, const FramePlan& plan, const dsl::SourceFiles& files);

// The parts of generated files that belong to one graph, inside its namespace.
std::string emit_declarations(const FrameApi& api, const FramePlan& plan);  // for the header
std::string emit_definitions(const FrameApi& api);                          // for the source

}  // namespace rg::compiler
