// From "who touches it as what" to Vulkan's stages, accesses and layouts.
#pragma once

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::compiler {

// What one access does to one aspect. Stages are kept apart by what happens in them: a later barrier needs availability only of writes.
struct Effect {
  Stages read_stages = 0, write_stages = 0;
  Accesses reads = 0, writes = 0;
  Layout layout = Layout::undefined;  // always undefined for buffers
  Stages stages() const { return read_stages | write_stages; }
  friend bool operator==(const Effect&, const Effect&) = default;
};

// `aspect` is one bit of AspectBits, 0 for buffers. Pre-condition: roles that shaders use have stages, see default_stages().
Effect effect_of(const dsl::Pass& pass, const dsl::Access& access, uint32_t aspect);

// The state an imported resource is brought in or left in; `wrote` states hold a write that is not yet available.
Effect effect_of(const dsl::BoundaryState& state, uint32_t aspect);

// Stage bits of an access that names none: fragment in raster passes, compute elsewhere.
uint32_t default_stages(const dsl::Pass& pass);

// VkImageUsageFlags or VkBufferUsageFlags.
uint32_t usage_of(const dsl::Pass& pass, dsl::Role role, dsl::ResourceKind kind, uint32_t aspects);

// Aspects an access touches when it names none: a descriptor sees depth only, an attachment its own aspect, a copy all.
uint32_t default_aspects(dsl::Role role, uint32_t format_aspects);

// True if the access leaves every element of its range defined whatever was there before, given that the pass runs.
bool defines_range(const dsl::Pass& pass, const dsl::Access& access);
// True if the result depends on what was there before.
bool needs_contents(const dsl::Pass& pass, const dsl::Access& access);
inline bool is_attachment(dsl::Role role) {
  return role == dsl::Role::color || role == dsl::Role::depth || role == dsl::Role::depth_readonly || role == dsl::Role::stencil;
}

// Accesses that one stage can make; stages of the table in access.def only.
Accesses supported_accesses(Stages stage);

// The latest stages alone: in an execution scope that comes first, a stage stands for all logically earlier ones.
Stages latest_stages(Stages stages);
// The earliest stages alone: in an execution scope that comes second, a stage stands for all logically later ones.
Stages earliest_stages(Stages stages);
// All stages that are logically earlier, or later, than one of `stages`, themselves included.
Stages with_earlier(Stages stages);
Stages with_later(Stages stages);

}  // namespace rg::compiler
