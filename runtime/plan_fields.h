// The rows of a plan field by field, and the file that holds plans: what its writer, in the compiler, and its reader, in the runtime, agree on.
//
//   magic "rgcplan\n" │ u32 kPlanFileVersion │ u32 kPlanVersion │ u64 kPlanShape │ u64 bytes of the body │ u64 checksum of the body │ body
//
//   body:   modules (a table of tables of words), then plans (a table of Plan)
//   table:  u32 rows, then the rows          row: its fields in order of declaration
//   field:  integers and floats little-endian at their own size, enumerators as their numbers, bool as one byte 0 or 1,
//           text as u32 bytes and the bytes; the words of a ShaderModule as the u32 index of a module, so that equal code is stored once
//
// A field that is added to plan.h and not to its list here does not compile; one that is renamed, moved or resized changes kPlanShape, and files
// written before are refused.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "runtime/plan.h"

namespace rg::plan_file {

inline constexpr std::string_view kMagic = "rgcplan\n";
inline constexpr uint32_t kPlanFileVersion = 1;
inline constexpr size_t kHeaderBytes = 8 + 4 + 4 + 8 + 8 + 8;

// FNV-1a, 64 bits.
constexpr uint64_t kChecksumStart = 0xcbf29ce484222325;
constexpr uint64_t checksum(std::string_view bytes, uint64_t seed = kChecksumStart) {
  for (const char byte : bytes) seed = (seed ^ static_cast<uint8_t>(byte)) * 0x100000001b3;
  return seed;
}
inline uint64_t checksum(std::span<const std::byte> bytes) { return checksum({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); }

// ---- fields -------------------------------------------------------------------------------------------------------

// `each_field(row, f)` calls f with all fields of the row, in order; `field_names<Row>` is their text.
template <class Row>
struct Fields;
#define RG_PLAN_ROW(Row, ...)                                             \
  template <>                                                             \
  struct Fields<Row> {                                                    \
    static constexpr std::string_view kNames = #Row "(" #__VA_ARGS__ ")"; \
    template <class Value, class F>                                       \
    static constexpr decltype(auto) visit(Value& row, F&& f) {            \
      auto& [__VA_ARGS__] = row;                                          \
      return std::forward<F>(f)(__VA_ARGS__);                             \
    }                                                                     \
  }

RG_PLAN_ROW(Expr, op, a, b, value);
RG_PLAN_ROW(Extent, name, axes, initial, maximum, minimum);
RG_PLAN_ROW(ClearValue, word);
RG_PLAN_ROW(Resource, name, kind, lifetime, dimension, format, width, height, depth, mips, layers, samples, aspects, usage, mutable_format, bytes,
            stride, layout, copies, init, init_value, is_surface, no_alias, concurrent, lazy, import_slot, estimated_bytes, estimated_alignment,
            estimated_offset, line, file);
RG_PLAN_ROW(Ref, resource, age);
RG_PLAN_ROW(Range, aspects, mip, mips, layer, layers);
RG_PLAN_ROW(Bytes, offset, size);
RG_PLAN_ROW(MemoryBarrier, src_stages, src_accesses, dst_stages, dst_accesses, tag);
RG_PLAN_ROW(ImageBarrier, image, range, src_stages, src_accesses, dst_stages, dst_accesses, old_layout, new_layout, src_queue, dst_queue, tag);
RG_PLAN_ROW(BufferBarrier, buffer, bytes, src_stages, src_accesses, dst_stages, dst_accesses, src_queue, dst_queue, tag);
RG_PLAN_ROW(BarrierGroup, first_memory, memory_count, first_image, image_count, first_buffer, buffer_count, event);
RG_PLAN_ROW(Acquire, resource, group, image_barrier, image_barriers, stages, accesses, queue, point, first_clock);
RG_PLAN_ROW(Release, resource, stages, accesses, queue, point);
RG_PLAN_ROW(Boundary, ref, range, stages, accesses, layout, queue, discard, bytes);
RG_PLAN_ROW(Access, ref, range, bytes, stages, accesses, layout, writes);
RG_PLAN_ROW(Attachment, ref, range, slice, slices, view_format, layout, load, store, clear, resolve, resolve_range, resolve_layout, resolve_mode);
RG_PLAN_ROW(Rendering, first_color, color_count, depth, stencil, width, height, layers, view_mask, samples);
RG_PLAN_ROW(ShaderModule, name, stage, words);
RG_PLAN_ROW(ColorBlend, enabled, src, dst, op, src_alpha, dst_alpha, op_alpha);
RG_PLAN_ROW(VertexAttribute, location, binding, offset, format);
RG_PLAN_ROW(VertexBuffer, ref, offset);
RG_PLAN_ROW(VertexBinding, stride, per_instance);
RG_PLAN_ROW(StencilFace, fail, pass, depth_fail, compare, read_mask, write_mask, reference);
RG_PLAN_ROW(RasterState, cull, front_clockwise, depth_test, depth_write, depth_compare, depth_bias_constant, depth_bias_slope, topology,
            alpha_to_coverage, stencil_test, stencil_front, stencil_back, depth_bounds, depth_min, depth_max, conservative, first_sample_location,
            sample_location_count);
RG_PLAN_ROW(SampleLocation, x, y);
RG_PLAN_ROW(Pipeline, name, pass, first_shader, shader_count, raster, first_blend, blend_count, first_vertex_binding, vertex_binding_count,
            first_vertex_attribute, vertex_attribute_count);
RG_PLAN_ROW(Binding, binding, type, stages, ref, range, bytes, view, arrayed, view_format, layout, sampler, params);
RG_PLAN_ROW(Sampler, name, linear, mip_linear, address, compare_enabled, compare, max_anisotropy);
RG_PLAN_ROW(Params, name, bytes, pass, layout);
RG_PLAN_ROW(Work, kind, x, y, z, arguments, arguments_offset, counts, max_draws, stride, first_transfer, transfer_count, first, vertex_offset,
            first_vertex_buffer, vertex_buffer_count, indices, indices_offset, index_bytes);
RG_PLAN_ROW(Transfer, kind, src, dst, src_range, dst_range, src_bytes, dst_bytes, linear, value, update_slot);
RG_PLAN_ROW(MipLimit, image, mip);
RG_PLAN_ROW(EngineSet, name, role);
RG_PLAN_ROW(Pass, name, module, kind, queue, guard, first_access, access_count, rendering, pipeline, first_binding, binding_count, first_params,
            params_count, push_bytes, push_stages, push_layout, engine_set, first_choice, choice_count, first_feature, feature_count, work, host_slot,
            first_mip_limit, mip_limit_count, line, file);
RG_PLAN_ROW(Queue, kind);
RG_PLAN_ROW(Step, kind, index);
RG_PLAN_ROW(Wait, queue, value, stages, frames_ago);
RG_PLAN_ROW(Signal, value, stages);
RG_PLAN_ROW(Batch, queue, first_step, step_count, first_wait, wait_count, first_signal, signal_count);
RG_PLAN_ROW(Feature, name, values, initial, capability, layout);
RG_PLAN_ROW(FeatureCondition, condition, feature, values);
RG_PLAN_ROW(Culled, pass, reason);
RG_PLAN_ROW(Plan, version, name, variant, variant_count, variant_name, exprs, extents, resources, queues, batches, steps, waits, signals, groups,
            memory_barriers, image_barriers, buffer_barriers, entry, exit, acquires, releases, alias_clocks, passes, accesses, renderings,
            attachments, shaders, pipelines, pipeline_shaders, blends, sample_locations, vertex_buffers, vertex_bindings, vertex_attributes, bindings,
            samplers, params, pass_params, features, pass_features, pipeline_choices, transfers, mip_limits, engine_sets, conditions,
            feature_conditions, needs, culled, estimated_heap_bytes);
#undef RG_PLAN_ROW

template <class Row, class F>
constexpr decltype(auto) each_field(Row& row, F&& f) {
  return Fields<std::remove_const_t<Row>>::visit(row, std::forward<F>(f));
}
template <class T>
concept PlanRow = requires {
  Fields<T>::kNames;
};
template <class T>
concept PlanNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T>
struct TableRow;  // of a span
template <class T>
struct TableRow<std::span<const T>> {
  using Row = T;
};
template <class T>
concept PlanTable = requires {
  typename TableRow<T>::Row;
};

// ---- the shape of plan.h ------------------------------------------------------------------------------------------

template <class T>
constexpr uint64_t shape(uint64_t seed) {
  if constexpr (std::is_array_v<T>) {
    return shape<std::remove_extent_t<T>>(seed * 31 + std::extent_v<T>);
  } else if constexpr (PlanTable<T>) {
    return shape<typename TableRow<T>::Row>(seed * 31 + 200);
  } else if constexpr (PlanNumber<T>) {
    return seed * 31 + sizeof(T);
  } else if constexpr (std::is_same_v<T, std::string_view>) {
    return seed * 31 + 100;
  } else {
    constexpr T kRow{};
    return each_field(kRow, [&](const auto&... fields) {
      uint64_t value = checksum(Fields<T>::kNames, seed);
      ((value = shape<std::remove_cvref_t<decltype(fields)>>(value)), ...);
      return value;
    });
  }
}
inline constexpr uint64_t kPlanShape = shape<Plan>(kChecksumStart);

// The fewest bytes that a value takes in a file: bounds what a damaged count can ask for.
template <class T>
constexpr size_t least_bytes() {
  if constexpr (std::is_array_v<T>) {
    return std::extent_v<T> * least_bytes<std::remove_extent_t<T>>();
  } else if constexpr (PlanTable<T> || std::is_same_v<T, std::string_view>) {
    return 4;
  } else if constexpr (PlanNumber<T>) {
    return sizeof(T);
  } else {
    constexpr T kRow{};
    return each_field(kRow, [](const auto&... fields) { return (size_t{0} + ... + least_bytes<std::remove_cvref_t<decltype(fields)>>()); });
  }
}

}  // namespace rg::plan_file
