#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "compiler/profiles.h"
#include "dsl/format_table.h"
#include "dsl/layout.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;
using dsl::Role;

// Limits the language can run into, and what every Vulkan 1.3 device has (the table of required limits of the specification).
struct LimitRow {
  const char* name;
  double least;
};
constexpr LimitRow kLimits[] = {{"maxImageDimension1D", 4096},
                                {"maxImageDimension2D", 4096},
                                {"maxImageDimension3D", 256},
                                {"maxImageDimensionCube", 4096},
                                {"maxImageArrayLayers", 256},
                                {"maxTexelBufferElements", 65536},
                                {"maxUniformBufferRange", 16384},
                                {"maxStorageBufferRange", 134217728},
                                {"maxPushConstantsSize", 128},
                                {"maxPerStageDescriptorSampledImages", 16},
                                {"maxPerStageDescriptorStorageImages", 4},
                                {"maxPerStageDescriptorStorageBuffers", 4},
                                {"maxPerStageDescriptorUniformBuffers", 12},
                                {"maxColorAttachments", 4},
                                {"maxFramebufferLayers", 256},
                                {"maxComputeWorkGroupInvocations", 128},
                                {"maxComputeSharedMemorySize", 16384},
                                {"maxSamplerAnisotropy", 16},
                                {"maxMemoryAllocationSize", 1073741824},
                                {"framebufferColorSampleCounts", 4},
                                {"maxVertexInputBindings", 16},
                                {"maxVertexInputAttributes", 16}};

double least_of(std::string_view name) {
  const auto* row = std::find_if(std::begin(kLimits), std::end(kLimits), [&](const LimitRow& each) { return each.name == name; });
  return row == std::end(kLimits) ? 0 : row->least;
}

struct Judge {
  const dsl::Program& program;
  const dsl::Graph& graph;
  const std::vector<int64_t> extents;  // maximal
  dsl::Diagnostics& diagnostics;
  std::set<std::pair<std::string, std::string>> told;  // feature or limit, and what uses it
};

void need(Judge& at, const char* feature, const std::string& user, dsl::Span span, const char* fallback) {
  for (const dsl::Profile& profile : at.program.profiles) {
    if (std::binary_search(profile.features.begin(), profile.features.end(), feature) || !at.told.emplace(feature, user).second) continue;
    at.diagnostics.report(DiagnosticKind::BeyondProfile, span, {user, feature, profile.name, fallback})
        .note(DiagnosticKind::ProfileIsHere, profile.span, {profile.name});
  }
}

void keep_within(Judge& at, const char* limit, double value, const std::string& what, dsl::Span span) {
  for (const dsl::Profile& profile : at.program.profiles) {
    const double most = limit_of(profile, limit);
    if (value <= most || !at.told.emplace(limit, what).second) continue;
    at.diagnostics.report(DiagnosticKind::OverProfileLimit, span, {what, fmt::format("{:g}", value), profile.name, fmt::format("{:g}", most), limit})
        .note(DiagnosticKind::ProfileIsHere, profile.span, {profile.name});
  }
}

std::string quoted(const char* kind, const std::string& name) { return std::string(kind) + " `" + name + "`"; }

// ---- resources

int64_t largest_side(const Judge& at, const dsl::Resource& image) {
  int64_t most = 1;
  for (const dsl::ExprId axis : {image.width, image.height, image.depth})
    if (axis.valid()) most = std::max(most, dsl::evaluate(at.program, axis, at.extents));
  return most;
}

const char* dimension_limit(dsl::Dimension dimension) {
  constexpr const char* kNames[] = {"maxImageDimension1D", "maxImageDimension2D", "maxImageDimension3D", "maxImageDimensionCube"};
  return kNames[static_cast<size_t>(dimension)];
}

void judge_image(Judge& at, const dsl::Resource& image) {
  const std::string name = quoted("image", image.name);
  if (dsl::info(image.format).is_block())
    need(at, "textureCompressionBC", name, image.span, "without it, bring the texels uncompressed, as `rgba8` or `rgba16f`");
  if (image.dimension == dsl::Dimension::cube && image.layers > 6)
    need(at, "imageCubeArray", name, image.span, "without it, use a cube for each, or layers of a plain image and pick the face in the shader");
  keep_within(at, dimension_limit(image.dimension), static_cast<double>(largest_side(at, image)), "the largest side of " + name, image.span);
  keep_within(at, "maxImageArrayLayers", image.layers, "the number of layers of " + name, image.span);
  keep_within(at, "framebufferColorSampleCounts", image.samples, "the number of samples of " + name, image.span);
}

void judge_buffer(Judge& at, const dsl::Resource& buffer) {
  if (!buffer.count.valid()) return;
  const auto count = static_cast<double>(dsl::evaluate(at.program, buffer.count, at.extents));
  const std::string name = quoted("buffer", buffer.name);
  if (buffer.format != dsl::Format::none) return keep_within(at, "maxTexelBufferElements", count, "the length of " + name, buffer.span);
  keep_within(at, "maxStorageBufferRange", count * buffer.stride, "the size in bytes of " + name, buffer.span);
}

// ---- passes

bool is_basic_storage(dsl::Format format) {
  using dsl::Format;
  constexpr Format kBasic[] = {Format::rgba32f,  Format::rgba16f, Format::r32f,   Format::rgba8, Format::rgba8_snorm,
                               Format::rgba32i,  Format::rgba16i, Format::rgba8i, Format::r32i,  Format::rgba32ui,
                               Format::rgba16ui, Format::rgba8ui, Format::r32ui};
  return std::find(std::begin(kBasic), std::end(kBasic), format) != std::end(kBasic);
}

void judge_storage(Judge& at, const dsl::Pass& pass, const dsl::Access& access) {
  const dsl::Resource& resource = at.graph.resources[access.resource];
  const bool image = resource.kind == dsl::ResourceKind::image;
  if (image && !is_basic_storage(dsl::seen_format(resource, access)))
    need(at, "shaderStorageImageExtendedFormats", quoted("storage of", resource.name), access.span,
         "without it, use `rgba8`, `rgba16f`, `r32f` or another basic format");
  if (image && resource.samples > 1)
    need(at, "shaderStorageImageMultisample", quoted("storage of", resource.name), access.span,
         "without it, resolve first and write the resolved image");
  const bool writes = access.mode != dsl::Mode::read && pass.kind == dsl::PassKind::raster;
  if (writes && (access.stages & dsl::stage_fragment))
    need(at, "fragmentStoresAndAtomics", quoted("pass", pass.name), access.span, "without it, write from a compute pass");
  if (writes && (access.stages & ~uint32_t{dsl::stage_fragment}))
    need(at, "vertexPipelineStoresAndAtomics", quoted("pass", pass.name), access.span, "without it, write from a compute pass");
}

void judge_sampler(Judge& at, const dsl::Access& access) {
  if (!access.sampler.valid()) return;
  const dsl::Sampler& sampler = at.program.samplers[access.sampler];
  if (sampler.max_anisotropy <= 0) return;
  need(at, "samplerAnisotropy", quoted("sampler", sampler.name), sampler.span, "without it, leave `anisotropy` out");
  keep_within(at, "maxSamplerAnisotropy", static_cast<double>(sampler.max_anisotropy), "the anisotropy of " + quoted("sampler", sampler.name),
              sampler.span);
}

void judge_stages(Judge& at, const dsl::Pass& pass) {
  for (const dsl::Shader& shader : pass.shaders) {
    if (shader.stage == dsl::stage_geometry)
      need(at, "geometryShader", quoted("pass", pass.name), shader.span, "without it, expand geometry in the vertex shader or with instances");
    if (shader.stage == dsl::stage_tess_control || shader.stage == dsl::stage_tess_eval)
      need(at, "tessellationShader", quoted("pass", pass.name), shader.span, "without it, draw a finer mesh made in a compute pass");
  }
}

void judge_draw(Judge& at, const dsl::Pass& pass) {
  const dsl::Draw& draw = pass.draw;
  if (draw.kind == dsl::DrawKind::indirect_count)
    need(at, "drawIndirectCount", quoted("pass", pass.name), pass.span, "without it, leave `count` out and clear the draws that are not used");
  const bool many = (draw.kind == dsl::DrawKind::indirect || draw.kind == dsl::DrawKind::indirect_count) && draw.max_draws > 1;
  if (many) need(at, "multiDrawIndirect", quoted("pass", pass.name), pass.span, "without it, say `max 1` and use instances");
  if (draw.per_draw.valid())
    keep_within(at, "maxPushConstantsSize", at.program.structs[draw.per_draw].size430,
                "the size in bytes of `" + at.program.structs[draw.per_draw].name + "`", pass.span);
  size_t attributes = 0;
  for (const dsl::VertexInput& input : draw.vertex) attributes += at.program.structs[input.type].fields.size();
  keep_within(at, "maxVertexInputBindings", static_cast<double>(draw.vertex.size()), "the number of vertex structs of " + quoted("pass", pass.name),
              pass.span);
  keep_within(at, "maxVertexInputAttributes", static_cast<double>(attributes), "the number of vertex fields of " + quoted("pass", pass.name),
              pass.span);
}

void judge_attachments(Judge& at, const dsl::Pass& pass) {
  const dsl::Access* first = nullptr;
  size_t colors = 0;
  for (const dsl::Access& access : pass.accesses) {
    if (access.role != Role::color) continue;
    ++colors;
    if (!first) first = &access;
    if (!(access.blend == first->blend))
      need(at, "independentBlend", quoted("pass", pass.name), access.span, "without it, blend all colours of a pass alike, or draw in two passes");
  }
  keep_within(at, "maxColorAttachments", static_cast<double>(colors), "the number of colours of " + quoted("pass", pass.name), pass.span);
}

// Descriptors that one stage of the pass sees. Stages are known where the host records, or once the shaders are.
void judge_descriptors(Judge& at, const dsl::Pass& pass) {
  std::array<double, 4> counts{};
  constexpr const char* kNames[] = {"maxPerStageDescriptorSampledImages", "maxPerStageDescriptorStorageImages", "maxPerStageDescriptorStorageBuffers",
                                    "maxPerStageDescriptorUniformBuffers"};
  for (const dsl::Access& access : pass.accesses) {
    const bool image = at.graph.resources[access.resource].kind == dsl::ResourceKind::image;
    if (access.role == Role::sampled || access.role == Role::input) ++counts[0];
    if (access.role == Role::storage) ++counts[image ? 1 : 2];
    if (access.role == Role::uniform) ++counts[3];
  }
  counts[3] += static_cast<double>(pass.params.size());
  constexpr const char* kWhat[] = {"sampled images", "storage images", "storage buffers", "uniform blocks"};
  for (size_t i = 0; i < counts.size(); ++i)
    keep_within(at, kNames[i], counts[i], std::string("the number of ") + kWhat[i] + " of " + quoted("pass", pass.name), pass.span);
}

void judge_scalar(Judge& at, dsl::StructId id) {
  if (!id.valid() || !dsl::is_scalar(at.program.structs[id])) return;
  const dsl::Struct& record = at.program.structs[id];
  need(at, "scalarBlockLayout", quoted("struct", record.name), record.span, "without it, leave `scalar` out; std430 pads three-component vectors");
}

void judge_pass(Judge& at, const dsl::Pass& pass) {
  judge_scalar(at, pass.draw.per_draw);
  for (const dsl::ParamsUse& use : pass.params) judge_scalar(at, at.graph.params[use.id].type);
  for (const dsl::Access& access : pass.accesses) {
    if (access.role == Role::storage) judge_storage(at, pass, access);
    if (access.role == Role::sampled) judge_sampler(at, access);
    const dsl::Resource& resource = at.graph.resources[access.resource];
    const bool block = access.role == Role::uniform || access.role == Role::storage;
    if (block && resource.kind == dsl::ResourceKind::buffer) judge_scalar(at, resource.element.record);
    if (access.role == Role::uniform && resource.count.valid())
      keep_within(at, "maxUniformBufferRange", static_cast<double>(dsl::evaluate(at.program, resource.count, at.extents)) * resource.stride,
                  "the size in bytes of uniform " + quoted("buffer", resource.name), access.span);
  }
  if (pass.multiview) need(at, "multiview", quoted("pass", pass.name), pass.span, "without it, draw each layer in a pass of its own");
  judge_stages(at, pass);
  judge_draw(at, pass);
  judge_attachments(at, pass);
  judge_descriptors(at, pass);
  const uint32_t* group = pass.dispatch.group;
  keep_within(at, "maxComputeWorkGroupInvocations", double{1} * group[0] * group[1] * group[2], "the group size of " + quoted("pass", pass.name),
              pass.span);
}

// Of all variants of the pass's shader.
uint32_t shared_bytes(const ShaderBundle& bundle, const PassShaders& pass) {
  uint32_t most = 0;
  for (const auto& configuration : pass.variants)
    for (const auto& row : configuration)
      for (const size_t shader : row) most = std::max(most, bundle.shaders[shader].shared_bytes);
  return most;
}

void judge_shared_memory(Judge& at, const dsl::Pass& pass, uint32_t bytes) {
  constexpr const char* kLimit = "maxComputeSharedMemorySize";
  const auto report = [&](const std::string& who, double most) -> dsl::Diagnostic& {
    return at.diagnostics.report(DiagnosticKind::SharedMemory, pass.shaders.front().span,
                                 {pass.shaders.front().path, pass.name, std::to_string(bytes), who, fmt::format("{:g}", most)});
  };
  if (at.program.profiles.empty() && bytes > least_of(kLimit)) report("vulkan 1.3", least_of(kLimit));
  for (const dsl::Profile& profile : at.program.profiles) {
    if (bytes <= limit_of(profile, kLimit)) continue;
    report("profile `" + profile.name + "`", limit_of(profile, kLimit)).note(DiagnosticKind::ProfileIsHere, profile.span, {profile.name});
    return;
  }
}

void judge_version(Judge& at) {
  constexpr uint32_t kLeastMinor = 3;
  for (const dsl::Profile& profile : at.program.profiles)
    if (profile.api_minor < kLeastMinor)
      at.diagnostics.report(DiagnosticKind::OverProfileLimit, profile.span,
                            {"the version of Vulkan that graphs need", "1.3", profile.name, fmt::format("1.{}", profile.api_minor), "api-version"});
}

}  // namespace

double limit_of(const dsl::Profile& profile, const char* name) {
  const auto at =
      std::lower_bound(profile.limits.begin(), profile.limits.end(), name, [](const auto& row, const char* wanted) { return row.name < wanted; });
  return at != profile.limits.end() && at->name == name ? at->value : least_of(name);
}

void judge_profiles(const dsl::Program& program, dsl::GraphId graph, const ShaderBundle& shaders, dsl::Diagnostics& diagnostics) {
  Judge at{program, program.graphs[graph], dsl::maximum_extents(program), diagnostics, {}};
  for (size_t i = 0; i < shaders.passes.size(); ++i)
    if (const uint32_t bytes = shared_bytes(shaders, shaders.passes[i]); bytes > 0) judge_shared_memory(at, at.graph.passes.rows[i], bytes);
  if (program.profiles.empty()) return;
  if (graph.value == 0) judge_version(at);
  for (const dsl::Resource& resource : at.graph.resources)
    resource.kind == dsl::ResourceKind::image ? judge_image(at, resource) : judge_buffer(at, resource);
  for (const dsl::Pass& pass : at.graph.passes) judge_pass(at, pass);
}

}  // namespace rg::compiler
