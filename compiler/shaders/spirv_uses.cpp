#include "compiler/shaders/spirv_uses.h"

#include <glslang/SPIRV/spirv.hpp>
#include <set>
#include <vector>

namespace rg::compiler {
namespace {

constexpr uint32_t kUnset = UINT32_MAX;

struct Variable {
  spv::StorageClass storage = spv::StorageClassFunction;
  uint32_t set = kUnset, binding = kUnset, location = kUnset;
  bool is_variable = false;
  ModuleUse use;
};

struct Module {
  std::vector<Variable> variables;  // by id
  std::vector<uint32_t> roots;      // by id: the variable a pointer or handle comes from; 0: none
  std::set<uint32_t> handle_types;  // images and samplers
};

void decorate(Module& module, const uint32_t* words, uint32_t count) {
  if (count < 4) return;
  Variable& variable = module.variables[words[1]];
  if (words[2] == spv::DecorationDescriptorSet) variable.set = words[3];
  if (words[2] == spv::DecorationBinding) variable.binding = words[3];
  if (words[2] == spv::DecorationLocation) variable.location = words[3];
}

void add_variable(Module& module, const uint32_t* words) {
  Variable& variable = module.variables[words[2]];
  variable.is_variable = true;
  variable.storage = static_cast<spv::StorageClass>(words[3]);
  module.roots[words[2]] = words[2];
}

bool derives_pointer(spv::Op op) {
  switch (op) {
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
    case spv::OpPtrAccessChain:
    case spv::OpCopyObject:
    case spv::OpImageTexelPointer:
    case spv::OpSampledImage:
    case spv::OpImage:
      return true;
    default:
      return false;
  }
}

bool is_read_modify_write(spv::Op op) {
  return (op >= spv::OpAtomicExchange && op <= spv::OpAtomicXor) || op == spv::OpAtomicFAddEXT || op == spv::OpAtomicFMinEXT ||
         op == spv::OpAtomicFMaxEXT;
}

bool reads_image(spv::Op op) { return (op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageRead) || op == spv::OpImageSparseRead; }

ModuleUse* use_of(Module& module, uint32_t id) {
  if (id >= module.roots.size() || module.roots[id] == 0) return nullptr;
  ModuleUse& use = module.variables[module.roots[id]].use;
  use.touched = true;
  return &use;
}

void load(Module& module, const uint32_t* words) {
  ModuleUse* use = use_of(module, words[3]);
  if (use == nullptr) return;
  if (module.handle_types.contains(words[1]))
    module.roots[words[2]] = module.roots[words[3]];
  else
    use->reads = true;
}

void call(Module& module, const uint32_t* words, uint32_t count) {
  for (uint32_t i = 4; i < count; ++i)
    if (ModuleUse* use = use_of(module, words[i])) *use = {true, true, true, true};
}

void set_flag(Module& module, uint32_t id, bool ModuleUse::*flag) {
  if (ModuleUse* use = use_of(module, id)) use->*flag = true;
}

void step(Module& module, spv::Op op, const uint32_t* words, uint32_t count) {
  switch (op) {
    case spv::OpDecorate:
      return decorate(module, words, count);
    case spv::OpTypeImage:
    case spv::OpTypeSampler:
    case spv::OpTypeSampledImage:
      module.handle_types.insert(words[1]);
      return;
    case spv::OpVariable:
      return add_variable(module, words);
    case spv::OpLoad:
      return load(module, words);
    case spv::OpStore:
    case spv::OpAtomicStore:
      return set_flag(module, words[1], &ModuleUse::writes);
    case spv::OpCopyMemory:
      set_flag(module, words[1], &ModuleUse::writes);
      return set_flag(module, words[2], &ModuleUse::reads);
    case spv::OpImageWrite:
      return set_flag(module, words[1], &ModuleUse::writes);
    case spv::OpAtomicLoad:
      return set_flag(module, words[3], &ModuleUse::reads);
    case spv::OpFunctionCall:
      return call(module, words, count);
    case spv::OpArrayLength:
    case spv::OpImageQuerySize:
    case spv::OpImageQuerySizeLod:
    case spv::OpImageQueryLevels:
    case spv::OpImageQuerySamples:
      use_of(module, words[3]);
      return;
    default:
      break;
  }
  if (derives_pointer(op)) {
    if (use_of(module, words[3]) != nullptr) module.roots[words[2]] = module.roots[words[3]];
  } else if (is_read_modify_write(op)) {
    set_flag(module, words[3], &ModuleUse::atomics);
  } else if (reads_image(op)) {
    set_flag(module, words[3], &ModuleUse::reads);
  }
}

ModuleUses collect(const Module& module) {
  ModuleUses uses;
  for (const Variable& variable : module.variables) {
    if (!variable.is_variable) continue;
    if (variable.set != kUnset && variable.binding != kUnset) uses.descriptors[{variable.set, variable.binding}] = variable.use;
    if (variable.storage == spv::StorageClassOutput && variable.location != kUnset) uses.outputs[variable.location] = variable.use;
    if (variable.storage == spv::StorageClassPushConstant && variable.use.touched) uses.push_constants = true;
  }
  return uses;
}

}  // namespace

ModuleUses find_uses(const Words& words) {
  constexpr size_t kHeaderWords = 5;
  if (words.size() < kHeaderWords) return {};
  const uint32_t bound = words[3];
  Module module{std::vector<Variable>(bound), std::vector<uint32_t>(bound, 0), {}};
  for (size_t at = kHeaderWords; at < words.size();) {
    const uint32_t count = words[at] >> spv::WordCountShift;
    if (count == 0 || at + count > words.size()) break;
    step(module, static_cast<spv::Op>(words[at] & spv::OpCodeMask), &words[at], count);
    at += count;
  }
  return collect(module);
}

}  // namespace rg::compiler
