// Vulkan's numbers of a plan as the C++ that names them.
#pragma once

#include <string>
#include <vector>

#include "compiler/codegen/cpp_writer.h"
#include "dsl/source.h"
#include "runtime/plan.h"

namespace rg::compiler {

std::string stages_text(Stages stages);  // "stage::copy | stage::compute_shader"
std::string accesses_text(Accesses accesses);
std::string layout_text(Layout layout);           // "Layout::general"
std::string aspects_text(uint32_t aspects);       // "aspect_depth | aspect_stencil"
std::string shader_stages_text(uint32_t stages);  // "VK_SHADER_STAGE_VERTEX_BIT | ..."

// What passes and resources are called in generated code; distinct, in plan order.
struct PlanNames {
  std::vector<std::string> passes, resources;
};
PlanNames plan_names(const Plan& plan);

// A path as it shall stand in generated text: relative to the root file's folder.
std::string shown_path(const dsl::SourceFiles& files, std::string_view path);
// "passes.rg:12"; empty for a span of no file.
std::string origin(const dsl::SourceFiles& files, dsl::Span span);

}  // namespace rg::compiler
