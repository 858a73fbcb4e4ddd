// The contract between compiler and runtime: a resolved frame as plain constexpr-able data.
//
// A plan is const and position-free: extents are expressions, memory is placed by the runtime from real requirements.
// Stages, accesses, layouts, usages and formats carry Vulkan's own numbers (static_asserted in runtime/vulkan_values.cpp), so that the
// executor copies them without translation; this header includes nothing of Vulkan.
//
//   plan ── batches ── steps ─┬─ barrier group (one vkCmdPipelineBarrier2, or the second half of a split one)
//                             ├─ set (the first half)
//                             └─ pass (rendering, pipeline, bindings, dispatch | draw | transfers | host callback)
//
// Ownership: every span points to storage that outlives the plan (static data in generated/, or a PlanData).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// Rows that belong together share a line.
// clang-format off
namespace rg {

inline constexpr uint32_t kPlanVersion = 1;
using Index = uint32_t;
inline constexpr Index kNone = UINT32_MAX;
inline constexpr uint32_t kRemaining = UINT32_MAX;  // VK_REMAINING_MIP_LEVELS / ARRAY_LAYERS

// ---- numbers of Vulkan --------------------------------------------------------------------------------------------

using Stages = uint64_t;    // VkPipelineStageFlags2
using Accesses = uint64_t;  // VkAccessFlags2
namespace stage {
inline constexpr Stages none = 0, draw_indirect = 0x2, vertex_shader = 0x8, tess_control_shader = 0x10, tess_eval_shader = 0x20, geometry_shader = 0x40,
                        fragment_shader = 0x80, early_fragment_tests = 0x100, late_fragment_tests = 0x200, color_attachment_output = 0x400,
                        compute_shader = 0x800, all_transfer = 0x1000, bottom_of_pipe = 0x2000, host = 0x4000, all_graphics = 0x8000, all_commands = 0x10000,
                        copy = 0x100000000, resolve = 0x200000000, blit = 0x400000000, clear = 0x800000000, index_input = 0x1000000000, vertex_attribute_input = 0x2000000000;
}
namespace access {
inline constexpr Accesses none = 0, indirect_command_read = 0x1, index_read = 0x2, vertex_attribute_read = 0x4, uniform_read = 0x8, input_attachment_read = 0x10,
                          shader_read = 0x20, shader_write = 0x40, color_attachment_read = 0x80, color_attachment_write = 0x100,
                          depth_stencil_attachment_read = 0x200, depth_stencil_attachment_write = 0x400, transfer_read = 0x800, transfer_write = 0x1000,
                          host_read = 0x2000, host_write = 0x4000, memory_read = 0x8000, memory_write = 0x10000,
                          shader_sampled_read = 0x100000000, shader_storage_read = 0x200000000, shader_storage_write = 0x400000000;
}
enum class Layout : uint32_t {
  undefined = 0, general = 1, color_attachment = 2, depth_stencil_attachment = 3, depth_stencil_read_only = 4, shader_read_only = 5,
  transfer_src = 6, transfer_dst = 7, depth_read_only_stencil_attachment = 1000117000, depth_attachment_stencil_read_only = 1000117001,
  depth_attachment = 1000241000, depth_read_only = 1000241001, stencil_attachment = 1000241002, stencil_read_only = 1000241003, present_src = 1000001002,
};
enum class Format : uint32_t { undefined = 0 };  // VkFormat
enum AspectBits : uint32_t { aspect_color = 1, aspect_depth = 2, aspect_stencil = 4 };  // VkImageAspectFlagBits

// ---- values known when the plan runs ------------------------------------------------------------------------------

enum class ExprOp : uint8_t { constant, extent, add, sub, mul, floor_div, ceil_div, min, max, mip };  // mip: max(a >> b, 1)
struct Expr {                // operands precede users; `extent`: value = 3 * extent + axis
  ExprOp op = ExprOp::constant;
  Index a = kNone, b = kNone;
  int64_t value = 0;
};
struct Extent {
  std::string_view name = {};
  uint32_t axes = 2;
  int64_t initial[3] = {1, 1, 1};
  int64_t maximum[3] = {1, 1, 1};
  int64_t minimum[3] = {1, 1, 1};
};

// ---- resources ----------------------------------------------------------------------------------------------------

enum class ResourceKind : uint8_t { image, buffer };
enum class Dimension : uint8_t { d1, d2, d3, cube };
enum class Lifetime : uint8_t { transient, history, persistent, imported, readback };
enum class InitKind : uint8_t { none, clear };
struct ClearValue { uint32_t word[4] = {0, 0, 0, 0}; };  // bits of VkClearColorValue; depth in word[0] as float bits, stencil in word[1]

struct Resource {
  std::string_view name = {};
  ResourceKind kind = ResourceKind::image;
  Lifetime lifetime = Lifetime::transient;
  Dimension dimension = Dimension::d2;
  Format format = Format::undefined;
  Index width = kNone, height = kNone, depth = kNone;  // Expr; kNone is 1
  uint32_t mips = 1, layers = 1, samples = 1;          // mips: declared maximum, clamped to the full chain
  uint32_t aspects = 0;
  uint32_t usage = 0;                                  // VkImageUsageFlags or VkBufferUsageFlags
  bool mutable_format = false;
  Index bytes = kNone;                                 // Expr, buffers
  uint32_t stride = 0;                                 // bytes an element
  uint32_t layout = 0;                                 // of an element: equal where fields have the same names, types and places
  uint32_t copies = 1;                                 // history n: n + 1; copy of age k at frame f is (f - k) mod copies
  InitKind init = InitKind::none;
  ClearValue init_value = {};
  bool is_surface = false;
  bool no_alias = false;
  bool concurrent = false;                             // shared by the families of all queues that use it; no ownership transfers
  bool lazy = false;                                   // a transient attachment that no rendering loads or stores: it may live on the chip
  Index import_slot = kNone;                           // position in the generated Imports
  uint64_t estimated_bytes = 0, estimated_alignment = 1, estimated_offset = 0;  // at the initial extents, by the device profile
  uint32_t line = 0;                                   // in the file that declares it
  std::string_view file = {};
};

struct Ref {  // a physical copy: resource and how many frames ago it was the current one
  Index resource = kNone;
  uint32_t age = 0;
  friend constexpr bool operator==(const Ref&, const Ref&) = default;
};
struct Range {  // image subresources; kRemaining reaches to the end
  uint32_t aspects = 0;
  uint32_t mip = 0, mips = kRemaining, layer = 0, layers = kRemaining;
  friend constexpr bool operator==(const Range&, const Range&) = default;
};
struct Bytes {  // of a buffer; Expr; kNone: offset 0, size to the end
  Index offset = kNone, size = kNone;
  friend constexpr bool operator==(const Bytes&, const Bytes&) = default;
};

// ---- synchronisation ----------------------------------------------------------------------------------------------

// Why an atom exists although no hazard of this frame's contexts needs it; `hazard` atoms must be irredundant.
enum class BarrierTag : uint8_t { hazard, valid_usage, workaround, merged_batch, boundary_join, alias_pair };
struct MemoryBarrier {
  Stages src_stages = 0; Accesses src_accesses = 0;
  Stages dst_stages = 0; Accesses dst_accesses = 0;
  BarrierTag tag = BarrierTag::hazard;
  friend constexpr bool operator==(const MemoryBarrier&, const MemoryBarrier&) = default;
};
struct ImageBarrier {
  Ref image = {};
  Range range = {};
  Stages src_stages = 0; Accesses src_accesses = 0;
  Stages dst_stages = 0; Accesses dst_accesses = 0;
  Layout old_layout = Layout::undefined, new_layout = Layout::undefined;
  Index src_queue = kNone, dst_queue = kNone;  // ownership transfer between Plan::queues; kNone: none
  BarrierTag tag = BarrierTag::hazard;
  friend constexpr bool operator==(const ImageBarrier&, const ImageBarrier&) = default;
};
struct BufferBarrier {
  Ref buffer = {};
  Bytes bytes = {};
  Stages src_stages = 0; Accesses src_accesses = 0;
  Stages dst_stages = 0; Accesses dst_accesses = 0;
  Index src_queue = kNone, dst_queue = kNone;
  BarrierTag tag = BarrierTag::hazard;
  friend constexpr bool operator==(const BufferBarrier&, const BufferBarrier&) = default;
};
// One vkCmdPipelineBarrier2. May be empty until alias hand-offs are patched in; an empty group is not recorded.
// With an event it is split: a step `set` earlier in its batch records vkCmdSetEvent2 and the group's own step vkCmdWaitEvents2. Its first scope is what
// comes before the set, its second one what comes after the wait, and what stands between them is in neither. No memory changes hands in such a group,
// nor do its barriers change owners.
struct BarrierGroup {
  Index first_memory = 0, memory_count = 0;
  Index first_image = 0, image_count = 0;
  Index first_buffer = 0, buffer_count = 0;
  Index event = kNone;  // events are numbered from 0 on
};

// The first use of a transient in a frame: where memory taken over from others must be handed on.
// The group's image barrier from `undefined` (kNone for buffers) receives the previous users' scope, and so does the group's memory barrier.
struct Acquire {
  Index resource = kNone;
  Index group = kNone;
  Index image_barrier = kNone;  // first of the barriers that discard this image; there may be several, consecutive
  uint32_t image_barriers = 0;
  Stages stages = 0; Accesses accesses = 0;  // of the first users
  Index queue = 0, point = 0;                // of `group`
  Index first_clock = kNone;                 // in Plan::alias_clocks, see there
};
// The last real users of a transient on one queue: what must have finished before its bytes are given away. One row a queue that has some.
//
// The points of a queue are its barrier groups that are not split and the ends of its batches, numbered in recorded order: where something can be ordered after what
// was recorded before it. `point` points stand before the last users; whoever is ordered after point `point` or a later one comes after them.
struct Release {
  Index resource = kNone;
  Stages stages = 0; Accesses accesses = 0;  // accesses: writes only, not yet made available
  Index queue = 0, point = 0;
};
// State of a range of a resource at the start and at the end of every frame. Established by the prologue at creation and resize.
struct Boundary {
  Ref ref = {};
  Range range = {};
  Stages stages = 0; Accesses accesses = 0;
  Layout layout = Layout::undefined;
  Index queue = kNone;
  bool discard = false;  // contents do not cross the boundary
  Bytes bytes = {};      // buffers
};

// ---- passes -------------------------------------------------------------------------------------------------------

struct Access {  // what one pass does to one resource, in Vulkan's terms; debug tools and dumps read it
  Ref ref = {};
  Range range = {};
  Bytes bytes = {};
  Stages stages = 0; Accesses accesses = 0;
  Layout layout = Layout::undefined;
  bool writes = false;
};

enum class LoadOp : uint8_t { load = 0, clear = 1, dont_care = 2, none = 3 };
enum class StoreOp : uint8_t { store = 0, dont_care = 1, none = 2 };
struct Attachment {
  Ref ref = {};
  Range range = {};             // one mip
  uint32_t slice = 0, slices = 0;  // of a 3D image; 0 slices: no 3D image
  Format view_format = Format::undefined;  // undefined: the image's own
  Layout layout = Layout::undefined;
  LoadOp load = LoadOp::load;
  StoreOp store = StoreOp::store;
  ClearValue clear = {};
  Ref resolve = {};             // resource kNone: none
  Range resolve_range = {};
  Layout resolve_layout = Layout::undefined;
  uint32_t resolve_mode = 0;  // VkResolveModeFlagBits
};
struct Rendering {
  Index first_color = 0, color_count = 0;  // in Plan::attachments
  Index depth = kNone, stencil = kNone;    // in Plan::attachments
  Index width = kNone, height = kNone;     // Expr
  uint32_t layers = 1, view_mask = 0, samples = 1;
};

enum class ShaderStage : uint32_t { vertex = 1, tess_control = 2, tess_eval = 4, geometry = 8, fragment = 16, compute = 32 };  // VkShaderStageFlagBits
struct ShaderModule {
  std::string_view name = {};   // "lighting/light_cull.comp"
  ShaderStage stage = ShaderStage::compute;
  std::span<const uint32_t> words = {};
};
enum class BlendFactor : uint8_t {  // VkBlendFactor
  zero, one, src_color, one_minus_src_color, dst_color, one_minus_dst_color, src_alpha, one_minus_src_alpha, dst_alpha, one_minus_dst_alpha,
};
enum class BlendOp : uint8_t { add, subtract, reverse_subtract, min, max };  // VkBlendOp
enum class Compare : uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };  // VkCompareOp
struct ColorBlend {
  bool enabled = false;
  BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
  BlendOp op = BlendOp::add;
  BlendFactor src_alpha = BlendFactor::one, dst_alpha = BlendFactor::zero;
  BlendOp op_alpha = BlendOp::add;
};
struct VertexAttribute { uint32_t location = 0, binding = 0, offset = 0; Format format = Format::undefined; };
struct VertexBuffer { Ref ref = {}; Index offset = kNone; };  // Expr, bytes; kNone: 0
struct VertexBinding { uint32_t stride = 0; bool per_instance = false; };
enum class StencilOp : uint8_t { keep, zero, replace, increment, decrement, invert, increment_wrap, decrement_wrap };  // VkStencilOp
struct StencilFace {
  StencilOp fail = StencilOp::keep, pass = StencilOp::keep, depth_fail = StencilOp::keep;
  Compare compare = Compare::always;
  uint32_t read_mask = 0, write_mask = 0, reference = 0;
};
struct RasterState {
  uint8_t cull = 0;        // VkCullModeFlags
  bool front_clockwise = false;
  bool depth_test = false, depth_write = false;
  Compare depth_compare = Compare::greater_equal;
  float depth_bias_constant = 0, depth_bias_slope = 0;
  uint8_t topology = 3;    // VkPrimitiveTopology
  bool alpha_to_coverage = false;
  bool stencil_test = false;
  StencilFace stencil_front = {}, stencil_back = {};
  // For devices that can: only pipelines that such a device chooses say so, see Pass::first_choice.
  bool depth_bounds = false;
  float depth_min = 0, depth_max = 1;
  bool conservative = false;                                    // VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT
  Index first_sample_location = 0, sample_location_count = 0;   // in Plan::sample_locations; 0: the device's own
};
struct SampleLocation { float x = 0, y = 0; };  // in the pixel, from 0 to 1
// A pipeline the runtime builds. Attachment formats and samples come from the pass's Rendering.
struct Pipeline {
  std::string_view name = {};
  Index pass = kNone;      // whose layout and rendering it is built for
  Index first_shader = 0, shader_count = 0;  // in Plan::pipeline_shaders (indices of Plan::shaders)
  RasterState raster = {};
  Index first_blend = 0, blend_count = 0;
  Index first_vertex_binding = 0, vertex_binding_count = 0;
  Index first_vertex_attribute = 0, vertex_attribute_count = 0;
};

enum class DescriptorType : uint32_t {  // VkDescriptorType
  sampler = 0, combined_image_sampler = 1, sampled_image = 2, storage_image = 3,
  uniform_texel_buffer = 4, storage_texel_buffer = 5, uniform_buffer = 6, storage_buffer = 7, uniform_buffer_dynamic = 8, input_attachment = 10,
};
struct Binding {  // one descriptor of set 1
  uint32_t binding = 0;
  DescriptorType type = DescriptorType::sampled_image;
  uint32_t stages = 0;     // ShaderStage bits
  Ref ref = {};                 // resource kNone: a parameter block or a bare sampler
  Range range = {};
  Bytes bytes = {};
  Dimension view = Dimension::d2;
  bool arrayed = false;    // view type *_ARRAY
  Format view_format = Format::undefined;  // undefined: the image's own
  Layout layout = Layout::undefined;
  Index sampler = kNone;
  Index params = kNone;    // uniform_buffer_dynamic: in Plan::params
};
struct Sampler {
  std::string_view name = {};
  bool linear = false, mip_linear = false;
  uint8_t address = 2;     // VkSamplerAddressMode
  bool compare_enabled = false;
  Compare compare = Compare::never;
  float max_anisotropy = 0;
};
struct Params {  // a block in the per-frame ring, dynamic offset
  std::string_view name = {};
  uint32_t bytes = 0;
  Index pass = kNone;
  uint32_t layout = 0;  // as Resource::layout
};

enum class PassKind : uint8_t { raster, compute, transfer, host };
enum class WorkKind : uint8_t {  // what the executor records for the pass, after rendering, pipeline and set are bound
  none, host, draw, draw_indirect, draw_indexed_indirect, draw_indirect_count, draw_indexed_indirect_count, dispatch, dispatch_indirect, transfers,
  draw_indexed,
};
struct Work {
  WorkKind kind = WorkKind::none;
  Index x = kNone, y = kNone, z = kNone;  // Expr: dispatch groups | vertices or indices, instances
  Ref arguments = {};
  Index arguments_offset = kNone;         // Expr, bytes
  Ref counts = {};
  uint32_t max_draws = 1, stride = 16;
  Index first_transfer = 0, transfer_count = 0;
  Index first = kNone, vertex_offset = kNone;  // Expr, direct draws: the first vertex or index; added to indices; kNone: 0
  Index first_vertex_buffer = 0, vertex_buffer_count = 0;  // in Plan::vertex_buffers, bindings from 0 on
  Ref indices = {};                       // resource kNone: not bound
  Index indices_offset = kNone;           // Expr, bytes; kNone: 0
  uint32_t index_bytes = 4;               // 2 or 4
};
enum class TransferKind : uint8_t { copy_image, copy_buffer, copy_buffer_to_image, copy_image_to_buffer, blit, clear_color, clear_depth_stencil, fill, update, resolve };
struct Transfer {
  TransferKind kind = TransferKind::copy_image;
  Ref src = {}, dst = {};
  Range src_range = {}, dst_range = {};
  Bytes src_bytes = {}, dst_bytes = {};
  bool linear = false;
  ClearValue value = {};
  Index update_slot = kNone;  // host bytes in the generated Updates
};
struct MipLimit { Index image = kNone; uint32_t mip = 0; };  // runs only while mip < the image's mips

enum class SetRole : uint8_t { engine = 0, pass = 1, material = 2, draw = 3 };
struct EngineSet { std::string_view name = {}; SetRole role = SetRole::engine; };

struct Pass {
  std::string_view name = {}, module = {};
  PassKind kind = PassKind::compute;
  Index queue = 0;                        // in Plan::queues
  uint64_t guard = 0;                     // all these conditions must hold, bits of Plan::conditions; 0: always runs
  Index first_access = 0, access_count = 0;
  Index rendering = kNone;
  Index pipeline = kNone;
  Index first_binding = 0, binding_count = 0;
  Index first_params = 0, params_count = 0;  // dynamic offsets, in binding order: Plan::pass_params (indices of Plan::params)
  uint32_t push_bytes = 0, push_stages = 0;
  uint32_t push_layout = 0;               // as Resource::layout, of the push constants
  Index engine_set = kNone;
  // Which of its pipelines the pass binds is chosen every frame: Plan::pipeline_choices[first_choice + s], s counting the combinations of the values of
  // its features (Plan::pass_features, indices of Plan::features), the first slowest. kNone there: the combination is excluded. No features: `pipeline`.
  Index first_choice = 0, choice_count = 0;
  Index first_feature = 0, feature_count = 0;
  Work work = {};
  Index host_slot = kNone;                // position of the callback in the generated recorder
  Index first_mip_limit = 0, mip_limit_count = 0;
  uint32_t line = 0;
  std::string_view file = {};
};

// ---- the frame ----------------------------------------------------------------------------------------------------

enum class QueueKind : uint8_t { graphics, compute, transfer };
struct Queue { QueueKind kind = QueueKind::graphics; };
enum class StepKind : uint8_t { barriers, pass, set };  // set: the event of the group `index`
struct Step { StepKind kind = StepKind::pass; Index index = kNone; };
// Every queue has one timeline semaphore. Its signals of a frame have the values 1, 2, ...; with S of them a frame, value v of frame f is f * S + v.
// A queue signals its last batch of the frame at least.
struct Wait {
  Index queue = kNone;
  uint64_t value = 0;
  Stages stages = 0;
  uint32_t frames_ago = 0;  // 1: the value of the frame before, nothing to wait for in the first frame
};
struct Signal { uint64_t value = 0; Stages stages = 0; };  // on the batch's own queue timeline
struct Batch {  // one VkSubmitInfo2; the batches of a plan are listed in a legal serial order, those of one queue are submitted in it
  Index queue = 0;
  Index first_step = 0, step_count = 0;
  Index first_wait = 0, wait_count = 0;
  Index first_signal = 0, signal_count = 0;
};
// What a device can do beside what every device can; rows of dsl/capability.def.
enum class Capability : uint8_t {
  none,
  subgroup_arithmetic,
  subgroup_ballot,
  subgroup_shuffle,
  subgroup_quad,
  subgroup_size_32,
  subgroup_size_64,
  depth_bounds,
  conservative_rasterization,
  barycentrics,
  sample_locations,
  multiview
};
struct Feature {  // that shaders are chosen by, or passes run by
  std::string_view name = {};
  uint32_t values = 2, initial = 0;
  Capability capability = Capability::none;  // 1 where the device has it, whatever the frame asks for
  uint32_t layout = 0;                       // equal where the values have the same names in the same order; 0: off and on
};
struct FeatureCondition {  // a condition that holds in frames in which the feature has one of the values
  Index condition = 0, feature = 0;
  uint64_t values = 0;  // a bit each
};
struct Culled { std::string_view pass = {}, reason = {}; };

struct Plan {
  uint32_t version = kPlanVersion;
  std::string_view name = {};
  uint32_t variant = 0, variant_count = 1;  // of the feature configuration this plan is for
  std::string_view variant_name = {};
  std::span<const Expr> exprs = {};
  std::span<const Extent> extents = {};
  std::span<const Resource> resources = {};
  std::span<const Queue> queues = {};
  std::span<const Batch> batches = {};
  std::span<const Step> steps = {};
  std::span<const Wait> waits = {};
  std::span<const Signal> signals = {};
  std::span<const BarrierGroup> groups = {};
  std::span<const MemoryBarrier> memory_barriers = {};
  std::span<const ImageBarrier> image_barriers = {};
  std::span<const BufferBarrier> buffer_barriers = {};
  std::span<const Boundary> entry = {}, exit = {};
  std::span<const Acquire> acquires = {};
  std::span<const Release> releases = {};
  // What has completed before an acquire: alias_clocks[first_clock .. + 2 * queues.size()), for each queue the largest point (see Release) of this
  // frame, then for each queue that of the frame before. kNone: nothing is known.
  std::span<const Index> alias_clocks = {};
  std::span<const Pass> passes = {};             // in execution order of the single-queue serialisation
  std::span<const Access> accesses = {};
  std::span<const Rendering> renderings = {};
  std::span<const Attachment> attachments = {};
  std::span<const ShaderModule> shaders = {};
  std::span<const Pipeline> pipelines = {};
  std::span<const Index> pipeline_shaders = {};
  std::span<const ColorBlend> blends = {};
  std::span<const SampleLocation> sample_locations = {};
  std::span<const VertexBuffer> vertex_buffers = {};
  std::span<const VertexBinding> vertex_bindings = {};
  std::span<const VertexAttribute> vertex_attributes = {};
  std::span<const Binding> bindings = {};
  std::span<const Sampler> samplers = {};
  std::span<const Params> params = {};
  std::span<const Index> pass_params = {};
  std::span<const Feature> features = {};
  std::span<const Index> pass_features = {};
  std::span<const Index> pipeline_choices = {};  // indices of pipelines
  std::span<const Transfer> transfers = {};
  std::span<const MipLimit> mip_limits = {};
  std::span<const EngineSet> engine_sets = {};
  std::span<const std::string_view> conditions = {};
  std::span<const FeatureCondition> feature_conditions = {};  // the host sets the others
  std::span<const Capability> needs = {};                     // what a device must have for this variant
  std::span<const Culled> culled = {};
  uint64_t estimated_heap_bytes = 0;
};

// Evaluates an Expr; extent_values holds 3 values an extent. kNone gives 1. O(nodes below `index`).
constexpr int64_t evaluate(std::span<const Expr> exprs, Index index, std::span<const int64_t> extent_values) {
  if (index == kNone) return 1;
  const Expr& e = exprs[index];
  if (e.op == ExprOp::constant) return e.value;
  if (e.op == ExprOp::extent) return extent_values[static_cast<size_t>(e.value)];
  const int64_t a = evaluate(exprs, e.a, extent_values), b = evaluate(exprs, e.b, extent_values);
  switch (e.op) {
    case ExprOp::add: return a + b;
    case ExprOp::sub: return a - b;
    case ExprOp::mul: return a * b;
    case ExprOp::floor_div: return b == 0 ? 0 : a / b;
    case ExprOp::ceil_div: return b == 0 ? 0 : (a + b - 1) / b;
    case ExprOp::min: return a < b ? a : b;
    case ExprOp::max: return a < b ? b : a;
    case ExprOp::mip: return (a >> b) < 1 ? 1 : (a >> b);
    default: return 0;
  }
}

}  // namespace rg
