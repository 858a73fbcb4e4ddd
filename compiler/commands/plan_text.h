// Parts of a plan as text for a person: what `rgc explain` and `rgc emit` print. Deterministic, one fact a line.
#pragma once

#include <string>

#include "compiler/compile.h"

namespace rg::commands {

// "depth (WRITE -> READ)": one line a barrier.
std::string barrier_group_text(const PlanData& plan, const BarrierGroup& group, const std::string& indent);
// Passes in order with the barrier groups between them.
std::string schedule_text(const PlanData& plan);
// For each resource: first and last pass that touches it, as positions in the schedule.
std::string lifetimes_text(const PlanData& plan);
// Transients by offset: bytes, place, who had the place before.
std::string memory_text(const PlanData& plan);
std::string barriers_text(const PlanData& plan);
// Passes with their accesses, as the program declares them.
std::string graph_text(const dsl::Program& program, const dsl::Graph& graph);
// The same for Graphviz: passes as boxes, resources as ellipses, culled passes dashed.
std::string graph_dot(const dsl::Program& program, const compiler::CompiledGraph& graph);

// "passes/lighting.rg:12"; empty where there is no place.
std::string place_text(const dsl::SourceFiles& sources, dsl::Span span);
// "image rgba16f 1920x1080", at the initial extents.
std::string resource_kind_text(const dsl::Program& program, const dsl::Resource& resource);
std::string mode_name(dsl::Mode mode);
std::string role_name(dsl::Role role);

}  // namespace rg::commands
