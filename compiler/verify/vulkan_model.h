// Vulkan's stages, accesses and layouts as small bit sets, and the rules that relate them.
//
// Source: Vulkan 1.3, chapter "Synchronization and Cache Control": tables of pipeline stages, of access types supported by
// stages, and the logical order of stages. The checker's own tables; the planner has others, on purpose.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/plan.h"

namespace rg::verify {

// One bit a stage that does work of its own; masks such as all_transfer stand for several.
enum StageIndex : uint32_t {
  kDrawIndirect,
  kIndexInput,
  kVertexAttributeInput,
  kVertexShader,
  kTessControlShader,
  kTessEvalShader,
  kGeometryShader,
  kEarlyTests,
  kFragmentShader,
  kLateTests,
  kColorOutput,
  kComputeShader,
  kCopy,
  kResolve,
  kBlit,
  kClear,
  kHost,
  kStageCount,
};
enum AccessIndex : uint32_t {
  kIndirectRead,
  kIndexRead,
  kVertexAttributeRead,
  kUniformRead,
  kInputAttachmentRead,
  kSampledRead,
  kStorageRead,
  kColorRead,
  kDepthStencilRead,
  kTransferRead,
  kHostRead,
  kStorageWrite,
  kColorWrite,
  kDepthStencilWrite,
  kTransferWrite,
  kHostWrite,
  kAccessCount,
};
using StageSet = uint32_t;
using AccessSet = uint32_t;

constexpr StageSet stage_bit(uint32_t stage) { return 1u << stage; }
constexpr AccessSet access_bit(uint32_t access) { return 1u << access; }
constexpr StageSet kAllStages = (1u << kStageCount) - 1;
constexpr AccessSet kAllWrites =
    access_bit(kStorageWrite) | access_bit(kColorWrite) | access_bit(kDepthStencilWrite) | access_bit(kTransferWrite) | access_bit(kHostWrite);
constexpr AccessSet kAllReads = ((1u << kAccessCount) - 1) & ~kAllWrites;

// What a raw mask of the plan covers.
StageSet expand_stages(Stages raw);
AccessSet expand_accesses(Accesses raw);
// Bits of `raw` that Vulkan gives no meaning here.
Stages unknown_stages(Stages raw);
Accesses unknown_accesses(Accesses raw);
// The one bit of `raw` that stands for `stage` / `access`; kNone if none or several do.
uint32_t raw_bit_of_stage(Stages raw, uint32_t stage);
uint32_t raw_bit_of_access(Accesses raw, uint32_t access);

// Logical order: a source scope also covers earlier stages, a destination scope later ones.
StageSet with_earlier(StageSet stages);
StageSet with_later(StageSet stages);
// Accesses that `stage` can perform.
AccessSet supported(uint32_t stage);
AccessSet supported_by_any(StageSet stages);

// Combined depth-stencil layouts mean one layout for each aspect.
Layout layout_of_aspect(Layout layout, uint32_t aspect);
// Image usage bits (VkImageUsageFlags) of which an image in `layout` needs at least one; 0: any.
uint32_t usage_for(Layout layout);

std::string stage_name(uint32_t stage);
std::string access_name(uint32_t access);
std::string layout_name(Layout layout);
std::string stages_text(StageSet stages);

}  // namespace rg::verify
