#include "compiler/shaders/statistics.h"

#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <bit>
#include <glslang/SPIRV/spirv.hpp>
#include <span>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

struct Instruction {
  spv::Op op = spv::OpNop;
  uint32_t type = 0, result = 0;
  uint32_t first_use = 0, use_count = 0;  // ids it takes, without its type: in Module::uses
  std::span<const uint32_t> words;
};

// ---- reading: SPIRV-Tools says which operands are ids

struct Module {
  explicit Module(const Words& all) : words(all) {}
  const Words& words;
  size_t read = 5;  // words, the header among them
  std::vector<uint32_t> uses;
  std::vector<Instruction> globals;
  std::vector<std::vector<Instruction>> functions;
  std::vector<uint32_t> scalars;  // by id of a type: 32-bit scalars of a value
  std::vector<uint32_t> bytes;    // by id of a type: size in workgroup memory
  std::vector<uint32_t> aligns;   // by id of a type
  std::vector<uint64_t> constants;
  std::vector<uint32_t> storage;  // by id of a pointer: its storage class + 1
  std::vector<uint32_t> pointee;  // by id of a pointer type
  std::span<const uint32_t> uses_of(const Instruction& i) const { return std::span(uses).subspan(i.first_use, i.use_count); }
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
  Instruction instruction{static_cast<spv::Op>(parsed->opcode),
                          parsed->type_id,
                          parsed->result_id,
                          static_cast<uint32_t>(module.uses.size()),
                          0,
                          std::span(module.words).subspan(module.read, parsed->num_words)};
  module.read += parsed->num_words;
  for (uint16_t i = 0; i < parsed->num_operands; ++i)
    if (is_id(parsed->operands[i].type)) module.uses.push_back(parsed->words[parsed->operands[i].offset]);
  instruction.use_count = static_cast<uint32_t>(module.uses.size()) - instruction.first_use;
  if (instruction.op == spv::OpFunction) module.functions.emplace_back();
  if (module.functions.empty())
    module.globals.push_back(instruction);
  else
    module.functions.back().push_back(instruction);
  return SPV_SUCCESS;
}

Module read(const Words& words) {
  Module module(words);
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
  for (const uint32_t member : m.uses_of(i)) {
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

// Bits by dense number of a value; a row a block.
class BitRows {
 public:
  BitRows(size_t rows, size_t bits) : words_((bits + 63) / 64), data_(rows * words_) {}
  uint64_t* row(size_t i) { return data_.data() + i * words_; }
  const uint64_t* row(size_t i) const { return data_.data() + i * words_; }
  size_t words() const { return words_; }

 private:
  size_t words_;
  std::vector<uint64_t> data_;
};

struct Block {
  size_t begin = 0, end = 0;         // instructions of the function
  std::vector<uint32_t> successors;  // numbers of blocks
};

class Liveness {
 public:
  // `sizes`: scalars by id, of the values that count.
  Liveness(const Module& module, const std::vector<Instruction>& function, const std::vector<uint32_t>& sizes)
      : module_(module), function_(function), number_of_(sizes.size(), kNone) {
    for (const Instruction& i : function)
      if (i.result != 0 && sizes[i.result] > 0) number_of_[i.result] = static_cast<uint32_t>(scalars_.size()), scalars_.push_back(sizes[i.result]);
    find_blocks();
    in_ = out_ = defined_ = BitRows(blocks_.size(), scalars_.size());
    for (size_t b = 0; b < blocks_.size(); ++b) find_own(b);
    add_edges();
  }

  uint32_t most() {
    while (sweep()) {
    }
    uint32_t most = 0;
    for (size_t b = 0; b < blocks_.size(); ++b) most = std::max(most, most_in(b));
    return most;
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  void find_blocks() {
    std::vector<uint32_t> block_of(number_of_.size(), kNone);  // by label
    for (size_t i = 0; i < function_.size(); ++i) {
      if (function_[i].op == spv::OpLabel) block_of[function_[i].result] = static_cast<uint32_t>(blocks_.size()), blocks_.push_back({i, i, {}});
      if (!blocks_.empty()) blocks_.back().end = i + 1;
    }
    for (Block& block : blocks_)
      for (const uint32_t label : successors(function_[block.end - 1]))
        if (block_of[label] != kNone) block.successors.push_back(block_of[label]);
  }

  std::vector<uint32_t> successors(const Instruction& last) const {
    const auto& w = last.words;
    if (last.op == spv::OpBranch) return {w[1]};
    if (last.op == spv::OpBranchConditional) return {w[2], w[3]};
    const auto uses = module_.uses_of(last);
    return last.op == spv::OpSwitch ? std::vector<uint32_t>(uses.begin() + 1, uses.end()) : std::vector<uint32_t>();
  }

  uint32_t number(uint32_t id) const { return id < number_of_.size() ? number_of_[id] : kNone; }
  static void set(uint64_t* row, uint32_t bit) { row[bit / 64] |= uint64_t{1} << bit % 64; }
  static bool has(const uint64_t* row, uint32_t bit) { return row[bit / 64] >> bit % 64 & 1; }

  // What the block needs from before, and what it makes. Phis take theirs on the edge.
  void find_own(size_t b) {
    for (size_t i = blocks_[b].begin; i < blocks_[b].end; ++i) {
      const Instruction& at = function_[i];
      if (at.op != spv::OpPhi)
        for (const uint32_t id : module_.uses_of(at))
          if (const uint32_t bit = number(id); bit != kNone && !has(defined_.row(b), bit)) set(in_.row(b), bit);
      if (const uint32_t bit = number(at.result); at.result != 0 && bit != kNone) set(defined_.row(b), bit);
    }
  }
  void add_edges() {
    for (size_t b = 0; b < blocks_.size(); ++b)
      for (const uint32_t next : blocks_[b].successors)
        for (size_t i = blocks_[next].begin + 1; i < blocks_[next].end && function_[i].op == spv::OpPhi; ++i)
          add_phi(function_[i], function_[blocks_[b].begin].result, b);
  }
  void add_phi(const Instruction& phi, uint32_t from, size_t b) {
    const auto uses = module_.uses_of(phi);
    for (size_t k = 0; k + 1 < uses.size(); k += 2)
      if (const uint32_t bit = number(uses[k]); uses[k + 1] == from && bit != kNone) set(out_.row(b), bit);
  }

  bool sweep() {
    bool changed = false;
    for (size_t b = blocks_.size(); b-- > 0;) {
      uint64_t *out = out_.row(b), *in = in_.row(b);
      const uint64_t* defined = defined_.row(b);
      for (const uint32_t next : blocks_[b].successors)
        for (size_t w = 0; w < out_.words(); ++w) out[w] |= in_.row(next)[w];
      for (size_t w = 0; w < out_.words(); ++w) {
        const uint64_t wider = in[w] | (out[w] & ~defined[w]);
        changed = changed || wider != in[w];
        in[w] = wider;
      }
    }
    return changed;
  }

  uint32_t most_in(size_t b) {
    uint64_t* live = out_.row(b);  // nobody needs it afterwards
    uint32_t now = 0;
    for (size_t w = 0; w < out_.words(); ++w)
      for (uint64_t rest = live[w]; rest != 0; rest &= rest - 1) now += scalars_[w * 64 + static_cast<size_t>(std::countr_zero(rest))];
    uint32_t most = now;
    for (size_t i = blocks_[b].end; i-- > blocks_[b].begin;) {
      const Instruction& at = function_[i];
      if (const uint32_t bit = number(at.result); at.result != 0 && bit != kNone && has(live, bit))
        live[bit / 64] &= ~(uint64_t{1} << bit % 64), now -= scalars_[bit];
      if (at.op == spv::OpPhi) continue;
      for (const uint32_t id : module_.uses_of(at))
        if (const uint32_t bit = number(id); bit != kNone && !has(live, bit)) set(live, bit), now += scalars_[bit];
      most = std::max(most, now);
    }
    return most;
  }

  const Module& module_;
  const std::vector<Instruction>& function_;
  std::vector<uint32_t> number_of_;  // by id; kNone: it does not count
  std::vector<uint32_t> scalars_;    // by number
  std::vector<Block> blocks_;
  BitRows in_{0, 0}, out_{0, 0}, defined_{0, 0};
};

uint32_t shared_bytes_of(const Module& m) {
  uint32_t bytes = 0;
  for (const Instruction& i : m.globals) {
    if (i.op != spv::OpVariable || i.words[3] != spv::StorageClassWorkgroup) continue;
    const uint32_t type = m.pointee[i.type];
    bytes = round_up(bytes, m.aligns[type]) + m.bytes[type];
  }
  return bytes;
}

}  // namespace

uint32_t shared_bytes(const Words& words) {
  constexpr size_t kHeaderWords = 5;
  bool found = false;
  for (size_t at = kHeaderWords; at < words.size() && !found; at += std::max<size_t>(words[at] >> spv::WordCountShift, 1))
    found = (words[at] & spv::OpCodeMask) == spv::OpVariable && at + 3 < words.size() && words[at + 3] == spv::StorageClassWorkgroup;
  return found ? find_statistics(words).shared_bytes : 0;
}

ShaderStatistics find_statistics(const Words& words) {
  Module module = read(words);
  std::vector<uint32_t> type_of(module.scalars.size());
  for (const Instruction& i : module.globals) {
    add_type(module, i);
    if (i.result != 0) type_of[i.result] = i.type;
  }
  ShaderStatistics statistics;
  statistics.shared_bytes = shared_bytes_of(module);
  for (const auto& function : module.functions) {
    std::vector<uint32_t> sizes(module.scalars.size());  // of values made here: constants are not
    for (const Instruction& i : function) {
      if (i.result == 0) continue;
      type_of[i.result] = i.type;
      if (i.type != 0) sizes[i.result] = module.scalars[i.type];
    }
    for (const Instruction& i : function) count(module, i, type_of, statistics);
    statistics.live_scalars = std::max(statistics.live_scalars, Liveness(module, function, sizes).most());
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
