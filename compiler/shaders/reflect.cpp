#include "compiler/shaders/reflect.h"

#include <algorithm>
#include <spirv_cross.hpp>
#include <tuple>
#include <unordered_set>

namespace rg::compiler {
namespace {

using spirv_cross::Compiler;
using spirv_cross::Resource;
using spirv_cross::SPIRType;

dsl::Dimension dimension(spv::Dim dim) {
  switch (dim) {
    case spv::Dim1D:
      return dsl::Dimension::d1;
    case spv::Dim3D:
      return dsl::Dimension::d3;
    case spv::DimCube:
      return dsl::Dimension::cube;
    default:
      return dsl::Dimension::d2;
  }
}

std::string without_prefix(const std::string& name) {
  constexpr std::string_view kPrefix = "rg_block_";
  return name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name;
}

ReflectedBinding reflect_binding(const Compiler& compiler, const Resource& resource, BindingKind kind) {
  ReflectedBinding binding;
  const SPIRType& type = compiler.get_type(resource.type_id);
  const bool is_block = type.basetype == SPIRType::Struct;
  binding.name = without_prefix(is_block ? compiler.get_name(resource.base_type_id) : resource.name);
  binding.set = compiler.get_decoration(resource.id, spv::DecorationDescriptorSet);
  binding.binding = compiler.get_decoration(resource.id, spv::DecorationBinding);
  binding.kind = kind;
  const bool texels = !is_block && type.basetype != SPIRType::Sampler && type.image.dim == spv::DimBuffer;
  if (texels) binding.kind = kind == BindingKind::storage_image ? BindingKind::storage_texel_buffer : BindingKind::texel_buffer;
  if (!is_block && !texels && type.basetype != SPIRType::Sampler) {
    binding.dimension = dimension(type.image.dim);
    binding.arrayed = type.image.arrayed;
  }
  return binding;
}

// Structs nest; each is reported where it is met, and once for each layout.
void collect_structs(const Compiler& compiler, const SPIRType& type, bool std140, std::vector<ReflectedStruct>& structs) {
  for (uint32_t i = 0; i < type.member_types.size(); ++i) {
    const SPIRType& member = compiler.get_type(type.member_types[i]);
    if (member.basetype != SPIRType::Struct) continue;
    ReflectedStruct found{compiler.get_name(member.parent_type ? spirv_cross::ID(member.parent_type) : spirv_cross::ID(member.self)), std140, {}};
    if (found.name.empty()) found.name = compiler.get_name(member.self);
    for (uint32_t m = 0; m < member.member_types.size(); ++m) found.offsets.push_back(compiler.type_struct_member_offset(member, m));
    if (std::find(structs.begin(), structs.end(), found) == structs.end()) structs.push_back(std::move(found));
    collect_structs(compiler, member, std140, structs);
  }
}

}  // namespace

Reflection reflect(const Words& words) {
  const Compiler compiler(words);
  const auto resources = compiler.get_shader_resources();
  const auto active = compiler.get_active_interface_variables();
  Reflection reflection;
  const auto add = [&](const auto& list, BindingKind kind) {
    for (const Resource& resource : list) {
      reflection.bindings.push_back(reflect_binding(compiler, resource, kind));
      reflection.bindings.back().statically_used = active.contains(resource.id);
    }
  };
  add(resources.sampled_images, BindingKind::combined_sampler);
  add(resources.separate_images, BindingKind::texture);
  add(resources.separate_samplers, BindingKind::texture);
  add(resources.storage_images, BindingKind::storage_image);
  add(resources.storage_buffers, BindingKind::storage_buffer);
  add(resources.uniform_buffers, BindingKind::uniform_buffer);
  add(resources.subpass_inputs, BindingKind::texture);
  for (const Resource& block : resources.uniform_buffers) collect_structs(compiler, compiler.get_type(block.base_type_id), true, reflection.structs);
  for (const Resource& block : resources.storage_buffers) collect_structs(compiler, compiler.get_type(block.base_type_id), false, reflection.structs);
  for (const Resource& block : resources.push_constant_buffers) {
    collect_structs(compiler, compiler.get_type(block.base_type_id), false, reflection.structs);
    reflection.push_constants_used |= active.contains(block.id);
  }
  const auto place = [](const ReflectedBinding& b) { return std::tie(b.set, b.binding, b.name); };
  std::sort(reflection.bindings.begin(), reflection.bindings.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return reflection;
}

}  // namespace rg::compiler
