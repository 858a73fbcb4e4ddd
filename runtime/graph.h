// A graph on a device: executes a plan frame after frame. The plan is const and shared; the instance owns heap, images, buffers,
// views, samplers, pipelines, descriptor sets, the parameter ring, command buffers and the timeline.
//
// Threading: one thread an instance at a time; several instances of one plan or device are independent.
// Cost: create and resize allocate; execute walks tables and neither allocates, hashes nor compares strings.
// Generated code wraps this in a typed API; use it directly only for tools.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/device.h"
#include "runtime/plan.h"
#include "runtime/result.h"

namespace rg {

// What a callback needs to build its own pipelines and to record. Valid while the instance lives and is not resized.
struct PassInfo {
  std::string_view name = {};
  std::span<const VkFormat> color_formats = {};
  VkFormat depth_format = VK_FORMAT_UNDEFINED, stencil_format = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  uint32_t view_mask = 0;
  VkExtent2D extent = {1, 1};                         // of the rendering, or of the dispatch
  VkPipelineLayout layout = VK_NULL_HANDLE;           // set 0 engine, 1 pass, push constants as declared
  VkPipeline pipeline = VK_NULL_HANDLE;               // the generated one, already bound; null where the pass names no shader
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;  // of set 1
  // The same attachments as a classic render pass, subpass 0, where the device was created to validate; null otherwise.
  VkRenderPass render_pass = VK_NULL_HANDLE;
};

// Passed to a callback while its pass is recorded; barriers, rendering scope, pipeline and set 1 are in place.
struct Recording {
  const DeviceFunctions& vk;
  VkCommandBuffer commands;
  const PassInfo& pass;
  VkDescriptorSet set = VK_NULL_HANDLE;
};
// Records one pass; `user` is FrameInputs::user.
using RecordFunction = void (*)(void* user, Recording& recording);

struct ImportedImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};  // view: all mips and layers, the declared dimension
// A part of a buffer of the engine's.
struct ImportedBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = VK_WHOLE_SIZE;
};
// One of the two, by the kind of the resource.
struct Import {
  ImportedImage image = {};
  ImportedBuffer buffer = {};
};

// A semaphore of the engine that a frame waits for or signals; value 0: a binary one.
// With an import slot it guards that import: the wait is part of the first batch on every queue that touches it (a binary semaphore: of the first
// such batch alone), the signal comes when its last user is done. Without, the whole frame waits, or is done.
struct SemaphoreUse {
  VkSemaphore semaphore = VK_NULL_HANDLE;
  uint64_t value = 0;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  Index import_slot = kNone;
};

// What one frame takes. Read during the call only.
struct FrameInputs {
  std::span<const Import> imports = {};                      // by Resource::import_slot
  std::span<const std::span<const std::byte>> params = {};   // by index of Plan::params, exactly `bytes` each
  RecordFunction const* callbacks = nullptr;                 // by Pass::host_slot
  void* user = nullptr;                                      // given to every callback
  uint64_t conditions = 0;                                   // bits of Plan::conditions
  std::span<const std::span<const std::byte>> updates = {};  // by Transfer::update_slot
  std::span<const VkDescriptorSet> engine_sets = {};         // by index of Plan::engine_sets
  std::span<const uint32_t> features = {};                   // values, by index of Plan::features; empty: the initial ones
  std::span<const SemaphoreUse> waits = {}, signals = {};    // at most 16 each
};

// How an engine runs jobs on its own threads, parts of a frame or pipelines: calls job(data, i) for every i below `count`, in any order, and returns
// when all are done.
struct Parallel {
  void (*run)(void* user, uint32_t count, void (*job)(void* data, uint32_t index), void* data) = nullptr;
  void* user = nullptr;
};

// A part of a frame for a command buffer of the engine's, which is being recorded, outside a rendering scope, and belongs to the family of
// Device::queue.
struct OwnCommands {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  Index last_pass = kNone;  // gets every step after the part before, up to and with this pass; the last part gets the rest
};
// What a submit of the engine's signals: a timeline semaphore that outlives the instance, with values that grow.
struct FrameDone {
  VkSemaphore timeline = VK_NULL_HANDLE;
  uint64_t value = 0;
};

// Memory that the transients of several instances take turns in: the views of a split screen, the faces of a probe, the versions of a plan. A frame
// of one waits, on the GPU, for the last frame of whoever had it before. One thread for all of them; lives as long as one of them does.
struct TransientHeap;
std::shared_ptr<TransientHeap> make_transient_heap();  // empty; grows with its first users

// How an instance is made. Spans are read during the call only.
struct GraphOptions {
  uint32_t frames_in_flight = 2;                                   // 1 to 4
  std::span<const int64_t> extents = {};                           // 3 values an extent; empty: the plan's initial ones
  std::span<const VkDescriptorSetLayout> engine_set_layouts = {};  // by index of Plan::engine_sets
  bool aliasing = true;
  bool poison = false;           // fills acquired transients with a pattern
  bool debug_readback = false;   // adds transfer usage so that dump() works
  bool submit_per_pass = false;  // times every pass in its own submit by the wall clock: for drivers whose timestamps do not separate passes
  bool single_queue = false;     // all of the plan's queues on Device::queue, in the order of its batches
  bool serial = false;           // single_queue, and every pass waits for all before it
  bool timestamps = true;        // two GPU timestamps a pass, for pass_times
  bool statistics = false;       // pipeline statistics of each pass, where the device has them
  uint32_t threads = 1;          // 1 to 64: that many record a frame; callbacks of different passes then run at the same time
  std::shared_ptr<TransientHeap> heap = {};  // null: transients have memory of their own
  Parallel parallel = {};                    // the engine's threads instead of the runtime's own; `threads` says how many to expect
  // 1 to 64: that many make the pipelines at creation, which returns when all are made. 0: those that record a frame where there are several, else
  // one a core; on a null device one, so that its calls come in one order. What an instance is, or why there is none, does not depend on it.
  uint32_t pipeline_threads = 0;
};

// Bytes of an instance: placed, if nothing was shared, the least that any placement needs, history and persistent resources, mapped memory, and
// images in memory that the driver backs only where a rendering does not fit on the chip; those are in no other figure.
struct MemoryReport {
  uint64_t heap_bytes = 0, unaliased_bytes = 0, lower_bound_bytes = 0, persistent_bytes = 0, host_bytes = 0, lazy_bytes = 0;
};
struct PassTime {
  std::string_view pass;
  double ms = 0;
  double begin_ms = 0;
};  // begin: after the frame's first timestamp, on the clock of its queue
// Of one pass of a graphics queue; zeros elsewhere.
struct PassStatistics {
  std::string_view pass;
  uint64_t vertices = 0, vertex_invocations = 0, primitives = 0, fragment_invocations = 0, compute_invocations = 0;
};
// Where a resource lies in its heap.
struct PlacedResource {
  std::string_view name;
  uint64_t offset = 0, bytes = 0;
};

// Contents of one resource after one pass, tightly packed, one mip, all layers or slices.
struct Dump {
  Format format = Format::undefined;
  uint32_t width = 1, height = 1, depth_or_layers = 1, bytes_per_texel = 1;
  std::vector<std::byte> bytes;
};

// A graph on a device, frame after frame; see the top of this file.
class GraphInstance {
 public:
  // The device and the tables that `plan` points to outlive the instance; the device may be moved.
  static Result<GraphInstance> create(Device& device, const Plan& plan, const GraphOptions& options);
  // An instance that goes on where `current` is: another variant of the plan, an edited one, or the same with other options. History and persistent
  // resources of the same name and shape are shared; others start from their initial values. `current` may be destroyed, or executed again later
  // (see continue_from). The device and extents are those of `current` where `options` has none. On failure nothing has changed.
  static Result<GraphInstance> create_successor(GraphInstance& current, const Plan& plan, const GraphOptions& options);
  // The next frame of this instance follows the last one of `other`: same frame number, same history, and it waits for it on the GPU. Both share
  // their kept resources, by create_successor. No stall of the host, no allocation beyond a few barriers.
  Status continue_from(GraphInstance& other);
  GraphInstance(GraphInstance&&) noexcept;  // leaves an object that can only be destroyed or assigned to
  GraphInstance& operator=(GraphInstance&&) noexcept;
  ~GraphInstance();  // waits for its own frames

  // Re-places and recreates what depends on extents; earlier frames go on undisturbed. On failure the old state stays. History and persistent
  // resources start from their initial values again.
  Status resize(std::span<const int64_t> extents);
  // Records and submits one frame. Waits only for the frame `frames_in_flight` ago. On failure the frame did not happen; the next call tries again,
  // after a resize to the same extents where a device of several queues had taken a part of it. A lost device stays lost: all later calls say so at
  // once.
  Status execute(const FrameInputs& inputs);
  // The next execute submits nothing but records into command buffers of the engine's (at most 64), who then ends and submits them in this order on
  // Device::queue, before this instance is called again, and makes that submit signal `done`. For plans of one queue, or with
  // GraphOptions::single_queue.
  Status use_commands(std::span<const OwnCommands> parts, const FrameDone& done);
  // Adds to the semaphores of the next frame that is executed, for callers that fill no FrameInputs themselves. At most 16 each, else
  // `invalid_argument`.
  Status use_semaphores(std::span<const SemaphoreUse> waits, std::span<const SemaphoreUse> signals);
  // Waits on the host for all frames of this instance. Cost: what is in flight.
  Status wait_idle();
  // Before its next use `resource` is set to its declared initial value again, all copies of it: its contents became wrong, as after a cut of the
  // camera or a change of the scene. On the GPU, between the frames before and the next one; the host waits for nothing but an earlier such reset.
  // `invalid_argument` for what is neither history nor persistent, or declares no initial value. Any number of resources; once a frame is enough.
  Status invalidate(Index resource);
  // Dynamic resolution: from the next frame on passes run over these extents, at most those of creation or resize; nothing is placed or made anew,
  // images keep their size and are used from their corner. Cost: O(passes), no allocation.
  Status set_active(std::span<const int64_t> extents);

  const Plan& plan() const;                        // that it runs; its tables are those that were given
  const PassInfo& pass_info(Index pass) const;     // `pass` below the number of passes. Valid until a resize
  MemoryReport memory() const;                     // at the extents of creation or resize
  std::vector<PlacedResource> placements() const;  // likewise; a tool: allocates
  // Of the last finished frame: GPU timestamps, or wall-clock times with submit_per_pass.
  std::vector<PassTime> pass_times();
  // Of the last finished frame, with GraphOptions::statistics; empty where the device has none.
  std::vector<PassStatistics> pass_statistics();
  // Contents of a `readback` buffer of the last finished frame (waits for it). Valid until the next execute.
  Result<std::span<const std::byte>> readback(Index resource);
  // The next execute keeps a copy of `resource` (mip `mip`) as it is right after `pass`; take it with take_dump. Several may be asked for at once:
  // they are taken in the order asked. A resize forgets what was asked for and not executed.
  Status request_dump(Index pass, Index resource, uint32_t mip = 0);
  Result<Dump> take_dump();  // the oldest; waits for its frame; `invalid_argument` where none was executed
  uint64_t frame() const;    // frames executed, those of the instances before included
  // Whether `prev(1)` of a history or persistent resource is what a frame has left, and not its initial value.
  bool history_valid(Index resource) const;

  struct State;  // graph_state.h, for the runtime's own files

 private:
  explicit GraphInstance(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace rg
