// A plan unrolled over frames: what the GPU does, as events, and which event must come before which.
//
// A pass is one event for each stage and access with which it touches a resource; an element of a barrier group is one event; so is what the
// engine does to imported resources before and after a frame. Events of two passes are ordered by nothing but barriers and semaphores.
#pragma once

#include <bitset>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/machine/cells.h"
#include "compiler/machine/hardware.h"
#include "compiler/machine/reference.h"

namespace rg::machine {

constexpr size_t kMaxAgents = 256;
using AgentSet = std::bitset<kMaxAgents>;  // of Timeline::agents

// Which half of a transfer between queue families a barrier is.
enum class Half : uint8_t { none, release, acquire };

enum class EventKind : uint8_t { read, write, barrier, bring };

struct Event {
  EventKind kind = EventKind::barrier;
  std::string label;  // "`light` reads `depth` (stage 0x800), frame 1"
  uint32_t frame = 0, queue = 0;
  Index pass = kNone;           // of the plan; kNone: a barrier or the engine
  uint32_t resource = kNone;    // of the program; kNone: all memory
  std::vector<uint32_t> cells;  // physical; empty and resource kNone: all
  // What it waits for and what waits for it.
  Stages stages = 0;            // of an access
  Stages src = 0, dst = 0;      // of a barrier, logically earlier and later stages included
  std::vector<uint32_t> after;  // besides: events that precede in any case
  uint32_t rendering = 0;       // of attachment work: a number of its own for each rendering begun
  bool after_all = false;       // fence or binary semaphore: all earlier events precede
  bool before_all = false;      // done before the first frame was submitted
  bool all_commands = false;    // a signal that also follows what barriers do of themselves
  // Ownership.
  uint32_t family = kNone;  // of the queue, where the resource belongs to one family at a time
  bool takes = false;       // contents start with this event, whoever had the resource before
  Half half = Half::none;
  uint32_t other_queue = kNone;  // of a transfer
  // Accesses.
  uint32_t agent = kNone;
  Layout layout = Layout::undefined;  // required; images only
  bool image = false;
  std::vector<Version> expected;   // read: what program order finds
  std::vector<Version> result;     // write: what program order leaves; bring: what the engine brings
  bool shares = false;             // commutes with neighbours that share
  bool partial = false;            // completed by a later event of the pass
  bool lost = false;               // the plan's load or store operation drops the contents
  bool pending = false;            // bring: the engine's write is not yet available
  bool through_semaphore = false;  // read: sees all that was written before it
  // Barriers.
  Index group = kNone;  // elements of one command
  Stages src_exact = 0, dst_exact = 0;
  Accesses src_accesses = 0, dst_accesses = 0;
  AgentSet src_agents = 0, dst_agents = 0;
  Layout old_layout = Layout::undefined, new_layout = Layout::undefined;
};

struct Agent {
  uint32_t queue = 0;
  Stages stage = 0;
  Accesses access = 0;
  friend bool operator==(const Agent&, const Agent&) = default;
};

struct Timeline {
  std::vector<Event> events;  // in submission order
  std::vector<Agent> agents;
  std::vector<std::pair<uint32_t, Layout>> initial_layouts;   // physical cell
  std::vector<std::pair<uint32_t, uint32_t>> initial_owners;  // physical cell, family
};

inline constexpr Layout kUnusable = static_cast<Layout>(UINT32_MAX);  // of an access the plan does not list, or lists in a layout its role forbids

struct Subject {  // all that is compared
  const dsl::Program& program;
  const dsl::Graph& graph;
  const Plan& plan;
  const std::vector<uint32_t>& program_pass;
  const std::vector<uint32_t>& program_resource;
  const MachineOptions& options;
  const Cells& cells;
  const Reference& reference;
};

Timeline unroll(const Subject& subject);

// predecessors[e]: events that precede e directly. All are smaller than e.
using Predecessors = std::vector<std::vector<uint32_t>>;
Predecessors find_order(const Timeline& timeline);

}  // namespace rg::machine
