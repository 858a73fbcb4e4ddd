// Program and plan joined into what the replays walk: steps over cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/verify/cells.h"
#include "compiler/verify/report.h"
#include "compiler/verify/roles.h"
#include "compiler/verify/vulkan_model.h"

namespace rg::verify {

// What is verified, as given.
struct Input {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const std::vector<uint32_t>& configuration;
  const Plan& plan;
  const std::vector<uint32_t>& program_pass;      // by plan pass
  const std::vector<uint32_t>& program_resource;  // by plan resource
};

// One declared access of a pass, with the operations the plan chose for it.
struct Use {
  uint32_t resource = 0, age = 0;  // program resource
  uint32_t access = 0;             // index in the program pass
  std::vector<uint32_t> cells;
  std::vector<Layout> layouts;   // by cell: what the plan says the cell is in; undefined where it says nothing
  std::vector<uint32_t> orders;  // by cell: commuting writers share a number; 0 none
  std::vector<Touch> touches;
  bool attachment = false, uses_contents = false, writes = false, commutes = false, clears = false;
  bool own_slices = false;     // clears or covers slices of a volume: load operations may drop those, and no others
  LoadOp load = LoadOp::load;  // attachments
  StoreOp store = StoreOp::store;
};

struct PassNode {
  uint32_t plan_pass = 0, program_pass = 0;
  uint32_t queue = 0;
  uint32_t rendering = 0;  // passes of one rendering share a number; 0 none
  bool first_in_rendering = true, last_in_rendering = true;
  std::vector<Use> uses;
};

// One barrier, wait or signal of the plan. Waits have no first scope of their own and signals no second; both name all accesses.
enum class ScopeKind : uint8_t { memory, image, buffer, wait, signal };
enum class Ownership : uint8_t { none, release, acquire };
struct Scope {
  ScopeKind kind = ScopeKind::memory;
  uint32_t index = 0;  // in the plan's table of that kind
  uint32_t group = 0;  // of the plan; waits and signals: batch
  uint32_t queue = 0;  // that executes it
  Stages raw_src = 0, raw_dst = 0;
  Accesses raw_src_accesses = 0, raw_dst_accesses = 0;
  StageSet src = 0, src_earlier = 0, dst = 0, dst_later = 0;
  AccessSet src_accesses = 0, dst_accesses = 0;
  uint32_t resource = 0, age = 0;
  std::vector<uint32_t> cells;
  Layout old_layout = Layout::undefined, new_layout = Layout::undefined;
  BarrierTag tag = BarrierTag::hazard;
  Ownership transfer = Ownership::none;
  uint32_t other = 0;  // transfer: the other queue; wait: the queue waited for
  uint64_t value = 0;  // wait, signal
  uint32_t frames_ago = 0;
  bool changes() const { return old_layout != new_layout || transfer != Ownership::none; }  // reads and writes its range
  bool has_range() const { return kind == ScopeKind::image || kind == ScopeKind::buffer; }
};

// Barriers of one group with the same stages order the same execution: none of several is needed for that.
struct ExecutionClass {
  uint32_t scope = 0;
  bool sole = true;
};

// Signals stand at the end of their batch, waits at its beginning. The first scopes of a split group are those of where it is set, the second ones
// those of where it is awaited.
enum class GroupKind : uint8_t { barriers, waits, signals, set, awaited };
struct GroupNode {
  GroupKind kind = GroupKind::barriers;
  uint32_t queue = 0;
  uint32_t plan_group = kNone;
  std::vector<uint32_t> scopes;
  std::vector<ExecutionClass> classes;
  StageSet src_earlier = 0, dst_later = 0;  // of all
  std::vector<uint32_t> memory;             // scopes of kind memory
  std::vector<uint32_t> handed_over;        // plan's acquires of buffers that a pair lets take over memory here
  uint32_t set_by = kNone;                  // awaited: the group, of kind set, that has the scopes
  uint32_t alike = kNone;  // signals and waits: a number for those of the queue with the same stages and queues, whatever they count to
};

struct StepNode {
  bool is_pass = false;
  uint32_t index = 0;  // in passes or groups
  uint32_t batch = 0;
};

struct BoundaryNode {
  uint32_t resource = 0, age = 0;
  std::vector<uint32_t> cells;
  StageSet stages = 0;
  AccessSet accesses = 0;
  Layout layout = Layout::undefined;
  uint32_t queue = kNone;
  bool discard = false;
};

struct ResourceNode {
  uint32_t plan = kNone;  // index in the plan; kNone: not planned
  uint32_t copies = 1;
  uint32_t first_cell = 0;  // of copy 0, in a numbering of all cells of all copies
  Partition partition;
};

struct Model {
  const Input* input = nullptr;
  std::vector<ResourceNode> resources;  // by program resource
  std::vector<PassNode> passes;         // by plan pass
  std::vector<Scope> scopes;
  std::vector<GroupNode> groups;
  std::vector<StepNode> steps;
  std::vector<BoundaryNode> entry, exit;
  uint32_t cell_count = 0;
  uint32_t history = 0;  // longest
  uint32_t queue_count = 1;
  std::vector<uint32_t> signals_on;  // by queue: signals of a frame
  std::vector<uint32_t> family;      // by queue: queues of one number share their families

  uint32_t cell(uint32_t resource, uint32_t copy, uint32_t cell) const {
    const ResourceNode& node = resources[resource];
    return node.first_cell + copy * node.partition.cell_count() + cell;
  }
  const dsl::Resource& resource(uint32_t index) const { return input->graph.resources.rows[index]; }
  bool is_exclusive(uint32_t resource) const {  // owned by one queue family at a time
    return resources[resource].plan != kNone && !input->plan.resources[resources[resource].plan].concurrent;
  }
  // The pass may not run in a frame in which the cell exists.
  bool may_skip(uint32_t plan_pass, uint32_t resource, uint32_t cell) const;
  const dsl::Pass& pass(uint32_t plan_pass) const { return input->graph.passes.rows[passes[plan_pass].program_pass]; }
  std::string pass_name(uint32_t plan_pass) const;
  std::string place(uint32_t resource, uint32_t cell) const;  // "`bloom` mip 2"
  std::string queue_name(uint32_t queue) const;               // "queue 1 (compute)"
};

// The cut of all resources at `extents`. `ranks` holds, for every range that occurs, the numbers of its first and last cut: where they are
// equal, so are the cells of every range, and so is the proof.
struct Cut {
  std::vector<Partition> partitions;  // by program resource
  std::vector<uint32_t> ranks;
};
Cut make_cut(const Input& input, const std::vector<int64_t>& extents);
// Requires check_indices() to have found nothing. Reports accesses the plan does not list or lists differently. `family`, by queue: where it is one
// for both sides of an ownership transfer, the release is left out and the acquire is a barrier like others, as the runtime records them.
Model make_model(const Input& input, const std::vector<int64_t>& extents, std::vector<Partition> partitions, const std::vector<uint32_t>& family,
                 Report& report);

}  // namespace rg::verify
