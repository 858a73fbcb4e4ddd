// The parts of a GraphInstance. Split by what they depend on: `Objects` only on the plan, `Sized` also on the extents.
// A resize builds a new Sized and retires the old one by timeline value.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "runtime/alias.h"
#include "runtime/device_state.h"
#include "runtime/graph.h"
#include "runtime/handles.h"

namespace rg {

// Where the work of a plan goes on a device; see queues.h.
struct QueueMap {
  std::vector<uint32_t> device_queue;    // by Plan::queues: in Device::State::queues
  std::vector<Index> of_group, of_pass;  // in Plan::queues
  std::vector<uint32_t> families;        // that may touch concurrent resources, without repetition; the first is that of Device::queue
  bool several = false;                  // more than one VkQueue
};

// What every creating function needs.
struct Context {
  Device::State& device;
  Plan plan;
  uint32_t frames_in_flight = 2;
  uint32_t threads = 1, pipeline_threads = 1;
  bool aliasing = true, poison = false, debug_readback = false, submit_per_pass = false, serial = false, timestamps = true, statistics = false;
  std::vector<VkDescriptorSetLayout> engine_set_layouts = {};
  Parallel parallel = {};
  std::shared_ptr<TransientHeap> heap = {};
  QueueMap queues = {};

  const DeviceFunctions& vk() const { return device.vk; }
};

// ---- independent of extents ---------------------------------------------------------------------------------------

// The part of a rendering that a pass is: the first begins it, the last ends it.
struct RenderingPart {
  bool first = true, last = true;
};

using SharedPipeline = std::shared_ptr<const UniquePipeline>;  // of instances that follow each other
struct MadePipeline {
  Index row = kNone;  // in Plan::pipelines
  SharedPipeline pipeline;
};
struct PassObjects {
  std::string name, module;
  VkDebugUtilsLabelEXT label{}, module_label{};  // of these names
  uint32_t module_number = 0;                    // equal for equal modules; 0: none
  std::vector<VkFormat> color_formats;
  UniqueSetLayout set_layout;  // of set 1; null: the empty one
  UniquePipelineLayout layout;
  RenderingPart part;
  UniqueRenderPass render_pass;          // only where classic render passes are recorded
  UniqueRenderPass whole_render_pass;    // where the pass is the first of several in a rendering
  std::vector<MadePipeline> pipelines;   // each once
  VkPipeline pipeline = VK_NULL_HANDLE;  // one of them; that of the initial features where the device has it
  std::vector<VkPipeline> choices;       // by combination of feature values; null: excluded
  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
};

struct Objects {
  std::vector<UniqueSampler> samplers;  // by Plan::samplers
  UniqueSetLayout empty_set_layout;
  std::vector<PassObjects> passes;  // by Plan::passes
};

// ---- dependent on extents -----------------------------------------------------------------------------------------

struct SizedResource {
  uint32_t first = 0, count = 0;  // physical copies in Sized::images or Sized::buffers; count 0: imported
  VkExtent3D extent = {1, 1, 1};
  uint32_t mips = 1, layers = 1;
  VkDeviceSize bytes = 0;  // buffers
};

// The physical copy that is `age` frames old at `frame`.
constexpr uint32_t copy_index(const SizedResource& resource, uint32_t age, uint64_t frame) {
  if (resource.count == 1) return resource.first;
  return resource.first + static_cast<uint32_t>((frame + resource.count - age % resource.count) % resource.count);
}

struct BufferSpan {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = VK_WHOLE_SIZE;
};
struct ByteRange {
  VkDeviceSize offset = 0, size = VK_WHOLE_SIZE;
};  // Bytes at the current extents

// Views of an imported image, which may be another one every frame. More entries than frames in flight, so that the one used
// longest ago is no longer in use.
struct ImportedView {
  Index resource = kNone;
  VkImageViewCreateInfo info{};
  VkImageViewUsageCreateInfo usage{};
  bool whole = false;  // covers the image: the engine's own view serves
  struct Entry {
    VkImage image = VK_NULL_HANDLE;
    UniqueView view;
    uint64_t frame = 0;
  };
  std::array<Entry, 16> entries;
  VkImageView current = VK_NULL_HANDLE;
  bool replaced = false;  // a view was destroyed: its handle may return with another meaning
};

struct ViewRef {  // one view per physical copy, or an imported one
  Ref ref;
  uint32_t first = 0;
  Index imported = kNone;  // in Sized::imported_views
  bool exists = true;      // false: its mips or layers vanished at these extents
};

// Row of a table that repeats every `period` frames; a division costs more than a Vulkan call.
constexpr uint64_t row_of(uint64_t frame, uint32_t period) { return period == 1 ? 0 : frame % period; }

struct GroupTable {  // one BarrierGroup as Vulkan sees it, once per combination of physical copies
  uint32_t period = 1;
  std::vector<VkMemoryBarrier2> memory;
  std::vector<VkImageMemoryBarrier2> images;
  std::vector<VkBufferMemoryBarrier2> buffers;
  std::vector<VkDependencyInfo> infos;  // by frame mod period
  Index poison = kNone;                 // in Sized::poisons
};
struct ImportedImageBarrier {
  Index slot = kNone;
  VkImageMemoryBarrier2* barrier = nullptr;
};
struct ImportedBufferBarrier {
  Ref ref;
  VkBufferMemoryBarrier2* barrier = nullptr;
  ByteRange bytes;
};

struct PoisonTable {  // fills what the group acquires; see poison.cpp
  struct Target {
    Index resource = kNone;
    VkImageSubresourceRange range{};
  };
  std::vector<Target> targets;
  std::vector<VkImageMemoryBarrier2> images;  // images of one copy only: transients have no history
};

struct FramebufferEntry {
  std::vector<VkImageView> views;
  UniqueFramebuffer framebuffer;
  uint64_t frame = 0;
};

struct RenderingTable {
  VkRect2D area{};
  uint32_t layers = 1, view_mask = 0, color_count = 0;
  bool has_depth = false, has_stencil = false;
  std::vector<ViewRef> views, resolve_views;           // colours, then depth, then stencil
  std::vector<VkRenderingAttachmentInfo> attachments;  // same order
  bool fixed = true;                                   // the views are the same in every frame, else they are filled in
  VkRenderingInfo info{};                              // points at `attachments`
  VkViewport viewport{};
  // Classic form, where recorded.
  VkRenderPass render_pass = VK_NULL_HANDLE;
  std::vector<FramebufferEntry> framebuffers;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;  // of this frame
  std::vector<ViewRef> framebuffer_views;
  std::vector<VkImageView> framebuffer_handles;
  std::vector<VkClearValue> clears;
  // The aspect of the depth and stencil attachment that the plan has left without a layout, and the one it gets before the render pass begins.
  VkImageAspectFlags loose_aspect = 0;
  VkImageLayout loose_layout = VK_IMAGE_LAYOUT_UNDEFINED;
  Ref loose_image;
  Range loose_range;
};

struct ImportedBinding {
  const Binding* binding = nullptr;
  Index view = kNone;  // in Sized::imported_views; kNone: a buffer
  Index slot = kNone;
  VkSampler sampler = VK_NULL_HANDLE;
  ByteRange bytes;
};
struct SetTable {
  uint32_t period = 0;                                // 0: the pass has no set
  std::vector<VkDescriptorSet> sets;                  // by frame mod period
  std::vector<ImportedBinding> imported;              // rewritten where the handle differs from the one last written
  std::vector<VkDescriptorImageInfo> written_images;  // by set, then imported binding
  std::vector<VkDescriptorBufferInfo> written_buffers;
  std::vector<uint32_t> block_offsets;    // of parameter blocks, in binding order
  std::vector<uint32_t> dynamic_offsets;  // the same plus this frame's section
};

struct TransferTable {
  const Transfer* transfer = nullptr;
  VkImageLayout src_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, dst_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  ByteRange src_bytes, dst_bytes;
  VkImageSubresourceRange range{};  // clears
  std::vector<VkImageCopy> copies;
  std::vector<VkImageBlit> blits;
  std::vector<VkImageResolve> resolves;
  std::vector<VkBufferImageCopy> buffer_copies;   // also updates of images
  uint32_t upload_offset = 0;                     // updates: in a section of the ring
  VkDeviceSize upload_bytes = 0, upload_now = 0;  // room, and bytes of this frame
};

struct DrawTable {  // of draws that the plan records
  uint32_t first = 0;
  int32_t vertex_offset = 0;
  VkDeviceSize indices_offset = 0;
  std::vector<VkDeviceSize> vertex_offsets;  // by binding
};

struct PassTable {
  bool runs = true;  // every mip that it touches exists
  PassInfo info;
  RenderingTable rendering;        // of this pass alone
  RenderingTable whole_rendering;  // of all passes of its rendering, where it is the first of several
  SetTable set;
  uint32_t x = 1, y = 1, z = 1;  // groups, or vertices or indices and instances
  VkDeviceSize arguments_offset = 0;
  DrawTable draw;
  std::vector<TransferTable> transfers;
};

// What every frame reads of a pass and of a barrier group, packed: a frame walks these and little else.
struct PassRow {
  uint64_t guard = 0;
  VkPipeline pipeline = VK_NULL_HANDLE;
  Index host_slot = kNone;
  WorkKind work = WorkKind::none;
  bool runs = true;
  bool has_rendering = false, begins_rendering = false, ends_rendering = false, shares_rendering = false;
  bool classic = false, fixed_views = false, has_set = false, has_engine_set = false;
};
struct GroupRow {
  const VkDependencyInfo* infos = nullptr;  // null: nothing to record, whatever the frame
  uint32_t period = 1;
  Index poison = kNone;
};

// What a frame that nobody watches records next, whole and side by side: the barriers of a group and the pass right behind them. See record_rows.h.
struct FrameRecording;
struct StepRow;
using RecordRow = void (*)(FrameRecording& recording, const StepRow& row);
struct StepRow {
  RecordRow record = nullptr;               // made for the shape of the row
  const VkDependencyInfo* infos = nullptr;  // recorded first, by frame mod period; null: no barriers
  const PassObjects* labels = nullptr;      // opened around `record`; null: none, or it opens them itself
  uint64_t guard = 0;
  uint32_t period = 1;
  Index host_slot = kNone, group = kNone, pass = kNone;  // kNone: there is none
  bool sets = false, awaits = false;                     // half of a split group
  const PassInfo* info = nullptr;
  const VkRenderingInfo* begun = nullptr;  // of the pass, or of all passes of its rendering
  const VkViewport* viewport = nullptr;
  const VkRect2D* area = nullptr;
};

// Host-written memory: one section a frame in flight with the parameter blocks, then the updates.
struct Ring {
  UniqueMemory memory;
  UniqueBuffer buffer;
  std::byte* mapped = nullptr;
  VkDeviceSize section = 0;
  std::vector<uint32_t> param_offsets;  // by Plan::params, within a section
};

// Contents that outlive plans and instances: one history or persistent resource with all its copies and memory of its own. Shared by the instances
// that take turns with it.
struct Kept {
  VkImageCreateInfo image{};  // what it was made with; the pointers in it are not followed
  VkBufferCreateInfo buffer{};
  std::vector<UniqueMemory> memories;  // one, or one a copy; declared before what lies in them
  std::vector<UniqueImage> images;
  std::vector<UniqueBuffer> buffers;
  uint64_t valid_since = 0;  // the frame that found it in its initial state
};

using Timelines = std::vector<UniqueSemaphore>;  // as in Moment; the plan's only where it signals

struct HostCopy {
  std::byte* mapped = nullptr;
  VkDeviceMemory memory = VK_NULL_HANDLE;
};  // of a readback buffer

struct TransferRef {
  Index pass = kNone, transfer = 0;  // in Sized::passes and their transfers
};

struct Sized {
  std::vector<int64_t> extents;
  std::vector<int64_t> values;                                 // of Plan::exprs at these extents
  std::vector<int64_t> active_extents;                         // at most `extents`; see GraphInstance::set_active
  std::vector<UniqueMemory> memories;                          // declared before what lies in it, so destroyed after it
  std::vector<std::shared_ptr<UniqueMemory>> shared_memories;  // of a TransientHeap
  std::vector<SizedResource> resources;                        // by Plan::resources
  std::vector<VkExtent3D> active;                              // by Plan::resources: at the active extents
  std::vector<UniqueImage> own_images;
  std::vector<UniqueBuffer> own_buffers;
  std::vector<std::shared_ptr<Kept>> kept;  // by Plan::resources; null: not history or persistent
  std::vector<bool> carried;                // by Plan::resources: `kept` came with its contents
  const Plan* carried_from = nullptr;       // in whose state between frames; only while the prologue is recorded
  bool carried_only = false;                // the prologue has nothing else to do; likewise
  bool resets = false;                      // the prologue resets what is not carried, which earlier frames have used; likewise
  std::vector<VkImage> images;              // of either owner
  std::vector<VkBuffer> buffers;
  std::vector<HostCopy> host_copies;  // by buffer; empty for those the host cannot see
  std::vector<UniqueView> views;
  std::vector<UniqueBufferView> buffer_views;
  std::vector<ImportedView> imported_views;
  Ring ring;
  UniqueDescriptorPool descriptor_pool;
  std::vector<GroupTable> groups;
  std::vector<ImportedImageBarrier> imported_images;
  std::vector<ImportedBufferBarrier> imported_buffers;
  std::vector<PoisonTable> poisons;
  std::vector<GroupRow> group_rows;
  std::vector<PassTable> passes;
  std::vector<PassRow> rows;
  std::vector<StepRow> step_rows;
  std::vector<Index> row_of_step;     // by Plan::steps, and the end: a group in front of a pass has the pass's row
  std::vector<TransferRef> updates;   // transfers whose bytes the host brings
  std::vector<Index> imported_sets;   // passes whose sets hold imports
  std::vector<alias::Placed> placed;  // by Plan::resources: transients in their heaps and in memory of their own, laid end to end
  MemoryReport report;
  std::vector<PlacedResource> placements;
};

// ---- per frame ----------------------------------------------------------------------------------------------------

// Values of an instance's timelines: [0] its own (prologues, single submits, frames of plans that signal nothing), [1 + q] of Plan::queues[q].
// Zeros: nothing to wait for.
inline constexpr size_t kMaxPlanQueues = 16;
struct Moment {
  std::array<uint64_t, 1 + kMaxPlanQueues> values{};
  VkSemaphore engine = VK_NULL_HANDLE;  // the newest that an engine named for frames it submitted itself, see GraphInstance::record
  uint64_t engine_value = 0;
};

// A run of steps that one thread records into one command buffer. Without threads: a batch, or a step with submit_per_pass.
struct Chunk {
  Index batch = 0;
  Index first_step = 0, step_count = 0;
  uint32_t pool = 0;  // of the slot
};
// Consecutive batches for one VkQueue: one vkQueueSubmit2.
struct SubmitCall {
  uint32_t queue = 0;  // in Device::State::queues
  Index first_batch = 0, batch_count = 0;
};

struct FrameSlot {
  std::vector<CommandPool> pools;         // by State::pool_families
  std::vector<VkCommandBuffer> commands;  // by State::chunks
  UniqueQueryPool queries;                // two timestamps a pass
  UniqueQueryPool statistics;             // one query a pass
  std::vector<UniqueEvent> events;        // by BarrierGroup::event; none where frames are recorded pass by pass
  std::vector<UniqueFence> fences;        // by Device::State::queues; only when validating: the layer learns nothing from waits on timelines
  std::vector<bool> fenced;               // which of them the last frame signals
  Moment done;                            // of its last frame
  std::vector<std::shared_ptr<Timelines>> sources;  // of other instances that its last frame waits for
  uint64_t frame = UINT64_MAX;
};

// Establishes entry states: a command buffer for Device::queue, then one for each other family that starts out owning something.
struct Prologue {
  std::vector<CommandPool> pools;  // by QueueMap::families
  std::vector<VkCommandBuffer> commands;
  std::vector<UniqueFence> fences;  // only when validating
  std::vector<bool> fenced;
  Moment done;
};

// In the order of PassStatistics.
inline constexpr VkQueryPipelineStatisticFlags kPipelineStatistics =
    VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT | VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT | VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
    VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;

inline constexpr size_t kMaxOwnCommands = 64;
inline constexpr size_t kMaxExternalSemaphores = 16;  // waits, and signals, of one frame
struct ImportUse {                                    // by import slot: batches that touch it, one a queue
  std::vector<Index> first, last;
};

struct DumpRequest {
  Index pass = kNone, resource = kNone;
  uint32_t mip = 0;
  UniqueMemory memory;
  UniqueBuffer buffer;
  std::byte* mapped = nullptr;
  Dump shape;
  VkDeviceSize bytes = 0;
  std::vector<VkImageLayout> layouts;  // by layer, right after the pass
  bool recorded = false;
  Moment done;
};

struct Retired {
  Moment moment;
  std::unique_ptr<Sized> sized;
};

// What instances that take turns with their transients share. Who comes after another waits for it as a whole, on the GPU.
struct TransientHeap {
  struct Block {
    uint32_t type = 0;
    VkDeviceSize bytes = 0;
    std::shared_ptr<UniqueMemory> memory;
  };
  std::vector<Block> blocks;             // the largest so far of each memory type
  const void* last_user = nullptr;       // a GraphInstance::State
  std::shared_ptr<Timelines> timelines;  // of the last user
  Moment moment;
};

class Workers;
struct WorkersDeleter {
  void operator()(Workers* workers) const;
};

struct GraphInstance::State {
  explicit State(Context c) : context(std::move(c)) {}
  ~State();

  Context context;
  Objects objects;
  std::shared_ptr<Timelines> timelines = std::make_shared<Timelines>();  // shared with whoever takes turns: it waits for them
  Moment submitted;                                                      // the last values that were submitted
  std::array<uint64_t, kMaxPlanQueues> signals_a_frame{};                // by Plan::queues
  std::vector<Chunk> chunks;                                             // in the order of steps
  std::vector<uint32_t> first_chunk;                                     // by batch, and the end
  std::vector<uint32_t> pool_families;
  std::vector<SubmitCall> calls;            // of a frame
  std::vector<Index> first_batch_of_queue;  // kNone: no batch
  std::vector<ImportUse> import_uses;
  std::vector<VkSemaphoreSubmitInfo> entry_waits;         // of the first batch on every queue of the next frame
  bool entry_barrier = false;                             // the next frame begins behind everything before it on each queue
  bool has_turn = false;                                  // the heap's last user is among the entry waits
  std::vector<std::shared_ptr<Timelines>> entry_sources;  // whose semaphores the last entry waits named
  std::vector<FrameSlot> slots;
  Prologue prologue;
  std::unique_ptr<Workers, WorkersDeleter> workers;
  std::vector<VkResult> chunk_results;
  bool broken = false;  // a frame was submitted in part: nothing is where the plan expects it
  std::unique_ptr<Sized> sized;
  std::vector<Retired> retired;
  uint64_t frame = 0;
  std::vector<Index> invalidated;            // to be reset before the next frame
  std::vector<SemaphoreUse> waits, signals;  // of the next frame, from use_semaphores; with room
  std::vector<OwnCommands> own_commands;     // of the next frame, from use_commands; with room
  FrameDone own_done;
  std::vector<uint32_t> features;              // of this frame, by Plan::features
  std::vector<Import> imports;                 // of this frame, by slot
  bool imports_applied = false;                // to the barriers of `sized`
  uint64_t sized_at = 0;                       // frames executed when `sized` was made
  std::vector<Index> imported;                 // resources
  std::vector<Index> host_passes, host_slots;  // side by side: a frame looks at the slots alone
  std::vector<Index> choosing_passes;          // whose pipelines features choose
  uint32_t update_slots = 0;
  std::vector<double> wall_ms;     // by pass, with submit_per_pass
  std::vector<DumpRequest> dumps;  // in the order asked
  std::vector<VkSubmitInfo2> submits;
  std::vector<VkCommandBufferSubmitInfo> submit_commands;
  std::vector<VkSemaphoreSubmitInfo> submit_waits, submit_signals;
};

}  // namespace rg
