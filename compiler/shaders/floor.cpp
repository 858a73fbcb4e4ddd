#include "compiler/shaders/floor.h"

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <set>

namespace rg::compiler {
namespace {

using dsl::Capability;

Capability capability_of(uint32_t spirv) {
  switch (spirv) {
    case spv::CapabilityGroupNonUniformArithmetic:
    case spv::CapabilityGroupNonUniformClustered:
      return Capability::subgroup_arithmetic;
    case spv::CapabilityGroupNonUniformBallot:
      return Capability::subgroup_ballot;
    case spv::CapabilityGroupNonUniformShuffle:
    case spv::CapabilityGroupNonUniformShuffleRelative:
      return Capability::subgroup_shuffle;
    case spv::CapabilityGroupNonUniformQuad:
      return Capability::subgroup_quad;
    case spv::CapabilityFragmentBarycentricKHR:
      return Capability::barycentrics;
    case spv::CapabilityMultiView:
      return Capability::multiview;
    default:
      return Capability::none;
  }
}

std::string name_of(Capability capability) {
  static constexpr const char* kNames[] = {
      "none",
#define RG_CAPABILITY(name, meaning) #name,
#include "dsl/capability.def"
#undef RG_CAPABILITY
  };
  return kNames[static_cast<size_t>(capability)];
}

bool asked_for(const PassContext& context, const VariantRow& row, Capability capability) {
  for (size_t i = 0; i < context.pass.features.size(); ++i) {
    const dsl::ShaderFeature& feature = context.pass.features[i];
    if (feature.feature.valid() && context.program.features[feature.feature].capability == capability && row.values[i] == 1) return true;
  }
  return false;
}

}  // namespace

std::vector<Capability> device_capabilities(const Words& words) {
  constexpr size_t kHeaderWords = 5;
  std::set<Capability> found;
  for (size_t at = kHeaderWords; at + 1 < words.size() && (words[at] & spv::OpCodeMask) == spv::OpCapability;
       at += words[at] >> spv::WordCountShift) {
    if (words[at] >> spv::WordCountShift != 2) break;
    if (const Capability capability = capability_of(words[at + 1]); capability != Capability::none) found.insert(capability);
  }
  return {found.begin(), found.end()};
}

bool check_floor(const PassContext& context, const dsl::Shader& shader, const VariantRow& row, const Words& words, dsl::Diagnostics& diagnostics) {
  for (const Capability capability : device_capabilities(words)) {
    if (asked_for(context, row, capability) || (capability == Capability::multiview && context.pass.multiview)) continue;
    const std::string name = name_of(capability);
    diagnostics.report(dsl::DiagnosticKind::BeyondProfile, shader.span,
                       {"shader `" + shader.path + "`", name, "vulkan 1.3",
                        "ask the device for it, `feature NAME : device " + name + "`, and write the lines that use it behind `#if FEATURE_NAME`"});
    return false;
  }
  return true;
}

}  // namespace rg::compiler
