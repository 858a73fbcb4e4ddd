#include "compiler/shaders/spirv_tools.h"

#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

constexpr spv_target_env kTarget = SPV_ENV_VULKAN_1_3;

Words run(spvtools::Optimizer& optimizer, const Words& words) {
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  Words result;
  RG_CHECK(optimizer.Run(words.data(), words.size(), &result, options), "SPIRV-Tools refused a module that had passed its validator");
  return result;
}

}  // namespace

std::string validate_spirv(const Words& words) {
  std::string problems;
  spvtools::SpirvTools tools(kTarget);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    if (!problems.empty()) problems += "; ";
    problems += message;
  });
  if (tools.Validate(words)) return "";
  return problems.empty() ? "invalid SPIR-V" : problems;
}

Words optimise_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPerformancePasses();
  return run(optimizer, words);
}

Words strip_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
  optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
  return run(optimizer, words);
}

}  // namespace rg::compiler
