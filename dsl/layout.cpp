#include "dsl/layout.h"

#include <algorithm>

#include "dsl/format_table.h"

namespace rg::dsl {
namespace {

constexpr uint64_t kMaxBytes = uint64_t{1} << 31;

uint64_t round_up(uint64_t value, uint64_t to) { return (value + to - 1) / to * to; }

// Packed fields lie in vertex buffers, which have one layout: aligned to their bytes, to a word at most.
TypeLayout packed_layout(const Type& type) {
  const uint64_t bytes = info(type.packed).block_bytes;
  return {bytes * std::max(type.count, 1u), std::min<uint64_t>(bytes, 4), bytes};
}

// Everything is aligned to its scalars, so nothing is padded.
TypeLayout scalar_layout(const Table<StructId, Struct>& structs, const Type& type) {
  TypeLayout result{4ull * type.rows * type.columns, 4, 0};
  if (type.record.valid()) result.size = structs[type.record].size430;
  result.stride = result.size;
  if (type.count == 0) return result;
  return {result.stride * type.count, 4, result.stride * type.count};
}

TypeLayout vector_layout(uint8_t rows) {
  const uint64_t size = 4ull * rows;
  return {size, rows == 3 ? 16 : size, 0};
}

TypeLayout element_layout(const Table<StructId, Struct>& structs, const Type& type, BlockLayout layout) {
  const bool is140 = layout == BlockLayout::std140;
  if (type.record.valid()) {
    const Struct& record = structs[type.record];
    return is140 ? TypeLayout{record.size140, record.align140, 0} : TypeLayout{record.size430, record.align430, 0};
  }
  const TypeLayout column = vector_layout(type.rows);
  if (type.columns == 1) return column;
  const uint64_t align = is140 ? round_up(column.align, 16) : column.align;  // a matrix is an array of columns
  return {round_up(column.size, align) * type.columns, align, 0};
}

struct Cursor {
  uint64_t offset = 0, align = 1;
};

bool place_field(const Table<StructId, Struct>& structs, const Type& type, BlockLayout layout, Cursor& cursor, uint32_t& offset) {
  const TypeLayout field = layout_of(structs, type, layout);
  cursor.offset = round_up(cursor.offset, field.align);
  cursor.align = std::max(cursor.align, field.align);
  if (cursor.offset + field.size > kMaxBytes) return false;
  offset = static_cast<uint32_t>(cursor.offset);
  cursor.offset += field.size;
  return true;
}

}  // namespace

TypeLayout layout_of(const Table<StructId, Struct>& structs, const Type& type, BlockLayout layout) {
  if (type.packed != Format::none) return packed_layout(type);
  if (layout == BlockLayout::scalar) return scalar_layout(structs, type);
  TypeLayout result = element_layout(structs, type, layout);
  const bool is140 = layout == BlockLayout::std140;
  const uint64_t align = is140 ? round_up(result.align, 16) : result.align;  // of an array's elements
  result.stride = round_up(result.size, align);
  if (type.count == 0) return result;
  return {result.stride * type.count, align, result.stride * type.count};
}

uint64_t scalar_size(const Table<StructId, Struct>& structs, const Type& type) {
  uint64_t size = type.packed == Format::none ? 4ull * type.rows * type.columns : info(type.packed).block_bytes;
  if (type.record.valid()) {
    size = 0;
    for (const Field& field : structs[type.record].fields) size += scalar_size(structs, field.type);
  }
  return size * std::max<uint64_t>(type.count, 1);
}

bool lay_out(const Table<StructId, Struct>& structs, Struct& record, bool scalar) {
  Cursor at140, at430;
  if (scalar) {
    at430.align = 4;
    for (Field& field : record.fields) {
      if (!place_field(structs, field.type, BlockLayout::scalar, at430, field.offset430)) return false;
      field.offset140 = field.offset430;
    }
    record.align140 = record.align430 = 4;
    record.size140 = record.size430 = static_cast<uint32_t>(round_up(at430.offset, 4));
    return true;
  }
  at140.align = 16;
  for (Field& field : record.fields) {
    if (!place_field(structs, field.type, BlockLayout::std140, at140, field.offset140)) return false;
    if (!place_field(structs, field.type, BlockLayout::std430, at430, field.offset430)) return false;
  }
  record.align140 = static_cast<uint32_t>(at140.align);
  record.align430 = static_cast<uint32_t>(std::max<uint64_t>(at430.align, 4));
  record.size140 = static_cast<uint32_t>(round_up(at140.offset, record.align140));
  record.size430 = static_cast<uint32_t>(round_up(at430.offset, record.align430));
  return true;
}

bool layouts_agree(const Table<StructId, Struct>& structs, const Struct& record) {
  if (is_scalar(record)) return true;
  return std::all_of(record.fields.begin(), record.fields.end(), [&](const Field& field) {
    if (field.offset140 != field.offset430) return false;
    const bool same_stride = layout_of(structs, field.type, BlockLayout::std140).size == layout_of(structs, field.type, BlockLayout::std430).size;
    return same_stride && (!field.type.record.valid() || layouts_agree(structs, structs[field.type.record]));
  });
}

}  // namespace rg::dsl
