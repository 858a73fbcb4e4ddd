// Sizes, alignments and offsets of types in std140 and std430 blocks (OpenGL 4.6 specification, section 7.6.2.2), and in scalar ones.
#pragma once

#include "dsl/program.h"

namespace rg::dsl {

enum class BlockLayout : uint8_t { std140, std430, scalar };
struct TypeLayout {
  uint64_t size = 0, align = 1;  // bytes; the size of an array is count * stride
  uint64_t stride = 0;           // bytes from one element of an array of this type to the next
};

// `structs` holds the layout of every struct that `type` names.
TypeLayout layout_of(const Table<StructId, Struct>& structs, const Type& type, BlockLayout layout);
// Bytes of `type` in a block of scalar layout (GL_EXT_scalar_block_layout): everything is aligned to its scalars, so nothing is padded.
uint64_t scalar_size(const Table<StructId, Struct>& structs, const Type& type);
// Fills offsets, sizes and alignments of `record`. False if a size exceeds 2^31 bytes.
bool lay_out(const Table<StructId, Struct>& structs, Struct& record, bool scalar = false);
// Whether blocks of the struct have scalar layout, and so all it holds: both its offsets are those. Nothing else is aligned so little in std140.
inline bool is_scalar(const Struct& record) { return record.align140 == 4; }
// Whether a C++ struct laid out for one kind of block also fits the other.
bool layouts_agree(const Table<StructId, Struct>& structs, const Struct& record);

}  // namespace rg::dsl
