#include "compiler/shaders/statistics.h"

#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <unordered_set>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

struct Instruction {
  spv::Op op = spv::OpNop;
  uint32_t type = 0, result = 0;
  std::vector<uint32_t> uses;  // ids it takes, without its type
  std::vector<uint32_t> words;
};

// ---- reading: SPIRV-Tools says which operands are ids

struct Module {
  std::vector<Instruction> globals;
  std::vector<std::vector<Instruction>> functions;
  std::vector<uint32_t> scalars;  // by id of a type: 32-bit scalars of a value
  std::vector<uint32_t> bytes;    // by id of a type: size in workgroup memory
  std::vector<uint32_t> aligns;   // by id of a type
  std::vector<uint64_t> constants;
  std::vector<uint32_t> storage;  // by id of a pointer: its storage class + 1
  std::vector<uint32_t> pointee;  // by id of a pointer type
  std::vector<bool> is_image_pointer;
};

bool is_id(spv_operand_type_t type) {
  return type == SPV_OPERAND_TYPE_ID || type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID || type == SPV_OPERAND_TYPE_SCOPE_ID;
}

spv_result_t read_header(void* user, spv_endianness_t, uint32_t, uint32_t, uint32_t, uint32_t bound, uint32_t) {
  auto& module = *static_cast<Module*>(user);
  for (auto* table : {&module.scalars, &module.bytes, &module.storage, &module.pointee}) table->assign(bound, 0);
  module.aligns.assign(bound, 1);
  module.constants.assign(bound, 0);
  return SPV_SUCCESS;
}

spv_result_t read_instruction(void* user, const spv_parsed_instruction_t* parsed) {
  auto& module = *static_cast<Module*>(user);
  Instruction instruction{static_cast<spv::Op>(parsed->opcode), parsed->type_id, parsed->result_id, {}, {}};
  instruction.words.assign(parsed->words, parsed->words + parsed->num_words);
  for (uint16_t i = 0; i < parsed->num_operands; ++i)
    if (is_id(parsed->operands[i].type)) instruction.uses.push_back(parsed->words[parsed->operands[i].offset]);
  if (instruction.op == spv::OpFunction) module.functions.emplace_back();
  if (module.functions.empty())
    module.globals.push_back(std::move(instruction));
  else
    module.functions.back().push_back(std::move(instruction));
  return SPV_SUCCESS;
}

Module read(const Words& words) {
  Module module;
  spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_3);
  const spv_result_t result = spvBinaryParse(context, &module, words.data(), words.size(), read_header, read_instruction, nullptr);
  spvContextDestroy(context);
  RG_CHECK(result == SPV_SUCCESS, "statistics are for valid modules");
  return module;
}

// ---- types

uint32_t round_up(uint32_t value, uint32_t alignment) { return (value + alignment - 1) / alignment * alignment; }

void set_type(Module& m, uint32_t id, uint32_t scalars, uint32_t bytes, uint32_t align) {
  m.scalars[id] = scalars, m.bytes[id] = bytes, m.aligns[id] = align;
}

void add_struct(Module& m, const Instruction& i) {
  uint32_t scalars = 0, bytes = 0, align = 1;
  for (const uint32_t member : i.uses) {
    scalars += m.scalars[member];
    bytes = round_up(bytes, m.aligns[member]) + m.bytes[member];
    align = std::max(align, m.aligns[member]);
  }
  set_type(m, i.result, scalars, round_up(bytes, align), align);
}

void add_type(Module& m, const Instruction& i) {
  const auto& w = i.words;
  switch (i.op) {
    case spv::OpTypeBool:
      return set_type(m, i.result, 1, 4, 4);
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
      return set_type(m, i.result, (w[2] + 31) / 32, w[2] / 8, w[2] / 8);
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
      return set_type(m, i.result, m.scalars[w[2]] * w[3], m.bytes[w[2]] * w[3], m.aligns[w[2]]);
    case spv::OpTypeArray: {
      const auto count = static_cast<uint32_t>(m.constants[w[3]]);
      return set_type(m, i.result, m.scalars[w[2]] * count, round_up(m.bytes[w[2]], m.aligns[w[2]]) * count, m.aligns[w[2]]);
    }
    case spv::OpTypeStruct:
      return add_struct(m, i);
    case spv::OpTypePointer:
      m.storage[i.result] = w[2] + 1;
      m.pointee[i.result] = w[3];
      return;
    case spv::OpConstant:
      m.constants[i.result] = w[3];
      return;
    default:
      return;
  }
}

// ---- counts

bool is_alu(spv::Op op) {
  return (op >= spv::OpConvertFToU && op <= spv::OpBitcast && op != spv::OpConvertPtrToU && op != spv::OpConvertUToPtr) ||
         (op >= spv::OpSNegate && op <= spv::OpSMulExtended) || (op >= spv::OpAny && op <= spv::OpFUnordGreaterThanEqual) ||
         (op >= spv::OpShiftRightLogical && op <= spv::OpBitCount) || (op >= spv::OpDPdx && op <= spv::OpFwidthCoarse) || op == spv::OpExtInst ||
         op == spv::OpVectorTimesScalar;
}
bool is_sample(spv::Op op) { return op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageDrefGather; }
bool is_atomic(spv::Op op) { return op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor; }
bool is_memory(uint32_t storage) {  // storage class + 1
  return storage == spv::StorageClassStorageBuffer + 1u || storage == spv::StorageClassUniform + 1u || storage == spv::StorageClassPushConstant + 1u;
}

void count(const Module& m, const Instruction& i, const std::vector<uint32_t>& type_of, ShaderStatistics& s) {
  ++s.instructions;
  s.alu += is_alu(i.op);
  s.samples += is_sample(i.op);
  s.atomics += is_atomic(i.op);
  s.barriers += i.op == spv::OpControlBarrier || i.op == spv::OpMemoryBarrier;
  s.branches += i.op == spv::OpBranchConditional || i.op == spv::OpSwitch;
  s.loads += i.op == spv::OpImageRead || (i.op == spv::OpLoad && is_memory(m.storage[type_of[i.words[3]]]));
  s.stores += i.op == spv::OpImageWrite || (i.op == spv::OpStore && is_memory(m.storage[type_of[i.words[1]]]));
}

// ---- liveness

struct Block {
  size_t begin = 0, end = 0;              // instructions of the function
  std::vector<uint32_t> successors;       // labels
  std::unordered_set<uint32_t> live_out;  // ids; only counted, never listed
};

class Liveness {
 public:
  Liveness(const std::vector<Instruction>& function, const std::vector<uint32_t>& sizes) : function_(function), sizes_(sizes) {
    for (size_t i = 0; i < function.size(); ++i) {
      if (function[i].op == spv::OpLabel) blocks_.push_back({i, i, {}, {}});
      if (!blocks_.empty()) blocks_.back().end = i + 1;
    }
    for (Block& block : blocks_) block.successors = successors(function[block.end - 1]);
  }

  uint32_t most() {
    while (sweep()) {
    }
    uint32_t most = 0;
    for (const Block& block : blocks_) most = std::max(most, most_in(block));
    return most;
  }

 private:
  bool counts(uint32_t id) const { return id < sizes_.size() && sizes_[id] > 0; }

  static std::vector<uint32_t> successors(const Instruction& last) {
    const auto& w = last.words;
    if (last.op == spv::OpBranch) return {w[1]};
    if (last.op == spv::OpBranchConditional) return {w[2], w[3]};
    std::vector<uint32_t> labels;
    if (last.op == spv::OpSwitch) labels.assign(last.uses.begin() + 1, last.uses.end());
    return labels;
  }

  const Block* find(uint32_t label) const {
    const auto at = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) { return function_[b.begin].result == label; });
    return at == blocks_.end() ? nullptr : &*at;
  }

  // Removes what the instruction makes and adds what it takes; phis take theirs on the edge.
  void step(const Instruction& i, std::unordered_set<uint32_t>& live) const {
    live.erase(i.result);
    if (i.op == spv::OpPhi) return;
    for (const uint32_t id : i.uses)
      if (counts(id)) live.insert(id);
  }

  std::unordered_set<uint32_t> live_in(const Block& block) const {
    std::unordered_set<uint32_t> live = block.live_out;
    for (size_t i = block.end; i-- > block.begin;) step(function_[i], live);
    return live;
  }

  bool sweep() {
    bool changed = false;
    for (size_t b = blocks_.size(); b-- > 0;) {
      Block& block = blocks_[b];
      const size_t before = block.live_out.size();
      for (const uint32_t label : block.successors) {
        const Block* next = find(label);
        if (next == nullptr) continue;
        block.live_out.merge(live_in(*next));
        for (size_t i = next->begin + 1; i < next->end && function_[i].op == spv::OpPhi; ++i)
          add_phi(function_[i], function_[block.begin].result, block);
      }
      changed = changed || block.live_out.size() != before;
    }
    return changed;
  }

  void add_phi(const Instruction& phi, uint32_t from, Block& block) const {
    for (size_t k = 0; k + 1 < phi.uses.size(); k += 2)
      if (phi.uses[k + 1] == from && counts(phi.uses[k])) block.live_out.insert(phi.uses[k]);
  }

  uint32_t most_in(const Block& block) const {
    std::unordered_set<uint32_t> live = block.live_out;
    uint32_t now = 0;
    for (const uint32_t id : live) now += sizes_[id];
    uint32_t most = now;
    for (size_t i = block.end; i-- > block.begin;) {
      const Instruction& at = function_[i];
      if (live.erase(at.result)) now -= sizes_[at.result];
      if (at.op == spv::OpPhi) continue;
      for (const uint32_t id : at.uses)
        if (counts(id) && live.insert(id).second) now += sizes_[id];
      most = std::max(most, now);
    }
    return most;
  }

  const std::vector<Instruction>& function_;
  const std::vector<uint32_t>& sizes_;
  std::vector<Block> blocks_;
};

uint32_t shared_bytes(const Module& m) {
  uint32_t bytes = 0;
  for (const Instruction& i : m.globals) {
    if (i.op != spv::OpVariable || i.words[3] != spv::StorageClassWorkgroup) continue;
    const uint32_t type = m.pointee[i.type];
    bytes = round_up(bytes, m.aligns[type]) + m.bytes[type];
  }
  return bytes;
}

}  // namespace

ShaderStatistics find_statistics(const Words& words) {
  Module module = read(words);
  std::vector<uint32_t> type_of(module.scalars.size());
  for (const Instruction& i : module.globals) {
    add_type(module, i);
    if (i.result != 0) type_of[i.result] = i.type;
  }
  ShaderStatistics statistics;
  statistics.shared_bytes = shared_bytes(module);
  for (const auto& function : module.functions) {
    std::vector<uint32_t> sizes(module.scalars.size());  // of values made here: constants are not
    for (const Instruction& i : function) {
      if (i.result == 0) continue;
      type_of[i.result] = i.type;
      if (i.type != 0) sizes[i.result] = module.scalars[i.type];
    }
    for (const Instruction& i : function) count(module, i, type_of, statistics);
    statistics.live_scalars = std::max(statistics.live_scalars, Liveness(function, sizes).most());
  }
  return statistics;
}

ShaderStatistics greatest(const ShaderStatistics& a, const ShaderStatistics& b) {
  ShaderStatistics most = a;
  for (uint32_t ShaderStatistics::*count :
       {&ShaderStatistics::instructions, &ShaderStatistics::alu, &ShaderStatistics::samples, &ShaderStatistics::loads, &ShaderStatistics::stores,
        &ShaderStatistics::atomics, &ShaderStatistics::barriers, &ShaderStatistics::branches, &ShaderStatistics::shared_bytes,
        &ShaderStatistics::live_scalars})
    most.*count = std::max(a.*count, b.*count);
  return most;
}

}  // namespace rg::compiler
