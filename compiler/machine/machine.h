// An abstract machine for plans: a GPU whose caches and schedulers do the worst that the plan's barriers allow.
//
// Memory maps cells (image aspect x mip piece x layer piece, or a byte interval; one set of cells a physical copy) to versions, 64-bit hashes of
// who wrote what in which frame. Every (queue, stage, access) triple is an agent with a cache of its own: writes stay dirty until an availability
// operation names them, old lines stay readable until a visibility operation drops them. A layout transition reads and writes its range. Queues run
// freely but for semaphores; what belongs to another queue family is lost.
//
//   plan, frames  -> events -> partial order (execution dependencies alone) -> schedules -> found versions
//   program        -> passes one after the other                             -> expected versions          the two must agree
//
// A schedule is a linear extension of the partial order. For every event there is one in which it comes as early as anything allows, so that
// everything it should have waited for comes late; plans of few commands are run in all orders. Each schedule runs with hoarding caches
// (write back last, refill first) and with none (write through, refill at use).
//
// Comparing every read instead of only outputs is the stronger test: if all reads agree, all terms agree by induction, and the first read that
// does not names the fault. Shares with planner and checker the plan schema and the program, nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::machine {

// Where a transient lies. Two that overlap destroy each other's contents when written; `bytes` 0: shares with nobody.
struct Placement {
  uint64_t offset = 0, bytes = 0;
};

struct MachineOptions {
  uint32_t frames = 3;                  // at least; a history n needs n + 2
  std::vector<Placement> placement;     // by plan resource; empty: nothing is aliased. Its hand-offs are patched into the plan.
  std::vector<int64_t> extents;         // 3 values an extent; empty: the initial ones
  bool united = false;                  // the device has one queue family: releases are not recorded, acquires are plain barriers
  std::vector<uint64_t> conditions;     // by frame, the last one repeats: bits by dsl::ConditionId; empty: none hold
  size_t exhaustive_commands = 5;       // plans of at most so many passes and barrier groups also run one frame in all orders ...
  size_t exhaustive_schedules = 20000;  // ... until so many were tried
  size_t max_divergences = 20;
};

struct Divergence {
  std::string pass, resource;  // who read the wrong version; pass empty: what is left when all is done
  uint32_t frame = 0;
  std::string expected, found;  // "`gbuffer` in frame 1", "poison", "two unordered writes", ...
  std::string schedule;         // the order and the caches that show it, one line
};
std::string text(const Divergence& divergence);

// Empty: no schedule tried gives any read another version than program order does. At most one divergence a (pass, resource).
// `configuration`: one value a feature. `program_pass[i]`, `program_resource[i]`: the program rows of plan pass and resource i.
// O(e^2) event executions for e events, e about frames * (accesses + barriers).
std::vector<Divergence> run_adversarially(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration,
                                          const Plan& plan, const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource,
                                          const MachineOptions& options = {});

}  // namespace rg::machine
