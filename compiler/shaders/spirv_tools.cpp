#include "compiler/shaders/spirv_tools.h"

#include <glslang/Public/ShaderLang.h>

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <map>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

constexpr spv_target_env kTarget = SPV_ENV_VULKAN_1_3;
constexpr size_t kHeaderWords = 5;

// Calls visit(op, words, count) for every instruction.
template <class Visit>
void for_each_instruction(const Words& words, Visit visit) {
  for (size_t at = kHeaderWords; at < words.size();) {
    const uint32_t count = words[at] >> spv::WordCountShift;
    if (count == 0 || at + count > words.size()) return;
    visit(static_cast<spv::Op>(words[at] & spv::OpCodeMask), &words[at], count);
    at += count;
  }
}

bool is_specialisation_id(spv::Op op, const uint32_t* words, uint32_t count) {
  return op == spv::OpDecorate && count == 4 && words[2] == spv::DecorationSpecId;
}

// Specialisation constants whose value follows from others.
bool has_derived_constants(const Words& words) {
  bool found = false;
  for_each_instruction(
      words, [&](spv::Op op, const uint32_t*, uint32_t) { found = found || op == spv::OpSpecConstantOp || op == spv::OpSpecConstantComposite; });
  return found;
}

bool is_plain_specialisation(spv::Op op) { return op == spv::OpSpecConstantTrue || op == spv::OpSpecConstantFalse || op == spv::OpSpecConstant; }

// The instruction with its constant set, appended to `out`.
void append_constant(spv::Op op, const uint32_t* words, uint32_t count, const uint32_t* value, Words& out) {
  if (op == spv::OpSpecConstant) {
    out.insert(out.end(), {count << spv::WordCountShift | spv::OpConstant, words[1], words[2]});
    for (uint32_t i = 3; i < count; ++i) out.push_back(value != nullptr && i == 3 ? *value : words[i]);
    return;
  }
  const bool truth = value != nullptr ? *value != 0 : op == spv::OpSpecConstantTrue;
  out.insert(out.end(), {count << spv::WordCountShift | (truth ? spv::OpConstantTrue : spv::OpConstantFalse), words[1], words[2]});
}

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
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);  // its own blocks are checked against the declaration, see agreement.cpp
  if (tools.Validate(words.data(), words.size(), options)) return "";
  return problems.empty() ? "invalid SPIR-V" : problems;
}

Words optimise_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPerformancePasses();
  return run(optimizer, words);
}

Words inline_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPass(spvtools::CreateWrapOpKillPass());
  optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
  optimizer.RegisterPass(spvtools::CreateMergeReturnPass());
  optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass());
  optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
  optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass(false));
  return run(optimizer, words);
}

std::set<uint32_t> specialisation_ids(const Words& words) {
  std::set<uint32_t> ids;
  for_each_instruction(words, [&](spv::Op op, const uint32_t* w, uint32_t count) {
    if (is_specialisation_id(op, w, count)) ids.insert(w[3]);
  });
  return ids;
}

Words set_constants(const Words& words, const std::vector<std::pair<uint32_t, uint32_t>>& values) {
  const std::map<uint32_t, uint32_t> by_number(values.begin(), values.end());
  std::map<uint32_t, uint32_t> by_result;  // id of the constant -> value
  for_each_instruction(words, [&](spv::Op op, const uint32_t* w, uint32_t count) {
    if (!is_specialisation_id(op, w, count)) return;
    if (const auto found = by_number.find(w[3]); found != by_number.end()) by_result.emplace(w[1], found->second);
  });
  Words out(words.begin(), words.begin() + kHeaderWords);
  out.reserve(words.size());
  for_each_instruction(words, [&](spv::Op op, const uint32_t* w, uint32_t count) {
    if (is_specialisation_id(op, w, count)) return;
    if (!is_plain_specialisation(op)) return void(out.insert(out.end(), w, w + count));
    const auto value = by_result.find(w[2]);
    append_constant(op, w, count, value == by_result.end() ? nullptr : &value->second, out);
  });
  return out;
}

Words prune_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
  if (has_derived_constants(words)) {
    optimizer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
    optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    optimizer.RegisterPass(spvtools::CreateSimplificationPass());
  }
  optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
  optimizer.RegisterPass(spvtools::CreateBlockMergePass());
  optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass(false));
  optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
  return run(optimizer, words);
}

Words finish_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPass(spvtools::CreateCCPPass());
  optimizer.RegisterPass(spvtools::CreateSimplificationPass());
  optimizer.RegisterPass(spvtools::CreateRedundancyEliminationPass());
  optimizer.RegisterPass(spvtools::CreateDeadBranchElimPass());
  optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass(false));
  optimizer.RegisterPass(spvtools::CreateBlockMergePass());
  optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
  return run(optimizer, words);
}

std::string tool_versions() {
  const glslang::Version front_end = glslang::GetVersion();
  return "pipeline " RGC_METHOD ", glslang " + std::to_string(front_end.major) + "." + std::to_string(front_end.minor) + "." +
         std::to_string(front_end.patch) + front_end.flavor + ", " + spvSoftwareVersionDetailsString();
}

Words strip_spirv(const Words& words) {
  spvtools::Optimizer optimizer(kTarget);
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
  optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
  return run(optimizer, words);
}

Words without_names(const Words& words) {
  constexpr spv::Op kNames[] = {spv::OpSource, spv::OpSourceContinued, spv::OpSourceExtension, spv::OpString, spv::OpName, spv::OpMemberName,
                                spv::OpLine,   spv::OpNoLine,          spv::OpModuleProcessed};
  Words out(words.begin(), words.begin() + kHeaderWords);
  out.reserve(words.size());
  for_each_instruction(words, [&](spv::Op op, const uint32_t* w, uint32_t count) {
    if (std::find(std::begin(kNames), std::end(kNames), op) == std::end(kNames)) out.insert(out.end(), w, w + count);
  });
  return out;
}

}  // namespace rg::compiler
