#include "runtime/pipelines.h"

#include <algorithm>
#include <atomic>

#include "runtime/capabilities.h"
#include "runtime/errors.h"
#include "runtime/make_pipeline.h"
#include "runtime/render_pass.h"
#include "runtime/workers.h"

namespace rg {

namespace {

constexpr uint32_t kPassSet = static_cast<uint32_t>(SetRole::pass);

Result<UniqueSetLayout> create_set_layout(const Context& context, std::span<const Binding> bindings, std::string_view name) {
  std::vector<VkDescriptorSetLayoutBinding> rows;
  for (const Binding& binding : bindings) rows.push_back({binding.binding, static_cast<VkDescriptorType>(binding.type), 1, binding.stages, nullptr});
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<uint32_t>(rows.size());
  info.pBindings = rows.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  RG_TRY(check(context.vk().CreateDescriptorSetLayout(context.device.device, &info, context.vk().allocator, &layout), "vkCreateDescriptorSetLayout",
               name));
  return UniqueSetLayout(context.vk(), context.device.device, layout);
}

// Sets in the order of their roles; roles that the pass does not use hold the empty layout.
std::vector<VkDescriptorSetLayout> set_layouts(const Context& context, const Objects& objects, const Pass& pass, const PassObjects& out) {
  const VkDescriptorSetLayout empty = objects.empty_set_layout.get();
  std::vector<VkDescriptorSetLayout> layouts = {empty, out.set_layout ? out.set_layout.get() : empty};
  if (pass.engine_set == kNone) return layouts;
  const size_t role = static_cast<size_t>(context.plan.engine_sets[pass.engine_set].role);
  layouts.resize(std::max(layouts.size(), role + 1), empty);
  layouts[role] = context.engine_set_layouts[pass.engine_set];
  return layouts;
}

Status create_layout(const Context& context, const Objects& objects, const Pass& pass, PassObjects& out) {
  const std::vector<VkDescriptorSetLayout> sets = set_layouts(context, objects, pass, out);
  if (pass.push_bytes > context.device.limits.maxPushConstantsSize)
    return Error{ErrorCode::unsupported, "pass `" + std::string(pass.name) + "`: " + std::to_string(pass.push_bytes) +
                                             " bytes of push constants; this device allows " +
                                             std::to_string(context.device.limits.maxPushConstantsSize)};
  const VkPushConstantRange push{pass.push_stages, 0, pass.push_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = static_cast<uint32_t>(sets.size());
  info.pSetLayouts = sets.data();
  info.pushConstantRangeCount = pass.push_bytes != 0 ? 1 : 0;
  info.pPushConstantRanges = &push;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  RG_TRY(
      check(context.vk().CreatePipelineLayout(context.device.device, &info, context.vk().allocator, &layout), "vkCreatePipelineLayout", pass.name));
  out.layout = UniquePipelineLayout(context.vk(), context.device.device, layout);
  return Done{};
}

// Whether the device answers its features as this combination of values has them; others may use what it lacks.
bool fits_device(const Context& context, const Pass& pass, uint32_t selector) {
  for (uint32_t i = pass.feature_count; i-- > 0;) {
    const Feature& feature = context.plan.features[context.plan.pass_features[pass.first_feature + i]];
    const uint32_t value = selector % feature.values;
    selector /= feature.values;
    const bool has = (context.device.capabilities & bit(feature.capability)) != 0;
    if (feature.capability != Capability::none && value != has) return false;
  }
  return true;
}

// Rows of Plan::pipelines, by combination of feature values; of one combination where the pass uses no features. kNone: not on this device.
std::vector<Index> rows_of(const Context& context, const Pass& pass) {
  if (pass.pipeline == kNone) return {};
  if (pass.choice_count == 0) return {pass.pipeline};
  std::vector<Index> rows;
  for (uint32_t selector = 0; selector < pass.choice_count; ++selector)
    rows.push_back(fits_device(context, pass, selector) ? context.plan.pipeline_choices[pass.first_choice + selector] : kNone);
  return rows;
}

const MadePipeline* find_row(const PassObjects& pass, Index row) {
  const auto found = std::find_if(pass.pipelines.begin(), pass.pipelines.end(), [row](const MadePipeline& made) { return made.row == row; });
  return found == pass.pipelines.end() ? nullptr : &*found;
}

// An entry of PassObjects::pipelines that has no pipeline yet.
struct Wanted {
  Index pass = kNone;
  size_t entry = 0;
};

// The pipelines of a pass, each once; those that the predecessor does not have are wanted.
Status list_pipelines(const Context& context, Index pass, const PipelineReuse& reuse, Shaders& shaders, PassObjects& out,
                      std::vector<Wanted>& wanted) {
  for (const Index row : rows_of(context, context.plan.passes[pass])) {
    if (row == kNone || find_row(out, row) != nullptr) continue;
    out.pipelines.push_back({row, reuse.find(context.plan.passes[pass], row, out)});
    if (out.pipelines.back().pipeline != nullptr) continue;
    wanted.push_back({pass, out.pipelines.size() - 1});
    RG_TRY(create_shaders(context, row, shaders));
  }
  return Done{};
}

void choose_pipelines(const Context& context, const Pass& pass, PassObjects& out) {
  for (const MadePipeline& made : out.pipelines)
    if (made.row == pass.pipeline || out.pipeline == VK_NULL_HANDLE) out.pipeline = made.pipeline->get();
  if (pass.choice_count == 0) return;
  for (const Index row : rows_of(context, pass)) out.choices.push_back(row == kNone ? VK_NULL_HANDLE : find_row(out, row)->pipeline->get());
}

// ---- making them ------------------------------------------------------------------------------------------------------

struct PipelineJobs {
  const Context& context;
  const Shaders& shaders;
  Objects& objects;
  std::span<const Wanted> wanted;
  std::vector<Status> results;
  std::atomic<uint32_t> first_failed = UINT32_MAX;
};

// Jobs behind one that failed are not begun; those before it are, whoever was faster: so the first of all that fail is always the one that is
// reported.
void make_wanted(void* data, uint32_t index) {
  PipelineJobs& jobs = *static_cast<PipelineJobs*>(data);
  uint32_t first = jobs.first_failed.load();
  if (index > first) return;
  const Wanted& wanted = jobs.wanted[index];
  PassObjects& pass = jobs.objects.passes[wanted.pass];
  MadePipeline& entry = pass.pipelines[wanted.entry];
  Result<UniquePipeline> made = make_pipeline(jobs.context, jobs.context.plan.passes[wanted.pass], entry.row, jobs.shaders, pass);
  if (made) {
    entry.pipeline = std::make_shared<const UniquePipeline>(std::move(*made));
    return;
  }
  jobs.results[index] = made.error();
  while (index < first && !jobs.first_failed.compare_exchange_weak(first, index)) {
  }
}

// On the engine's threads, on those that record, or on some that are gone afterwards.
void run_jobs(const GraphInstance::State& state, PipelineJobs& jobs) {
  const Context& context = state.context;
  const auto count = static_cast<uint32_t>(jobs.wanted.size());
  const uint32_t threads = std::min(context.pipeline_threads, count);
  if (threads > 1 && context.parallel.run != nullptr) {
    context.parallel.run(context.parallel.user, count, make_wanted, &jobs);
  } else if (threads > 1 && state.workers && context.pipeline_threads == context.threads) {
    state.workers->run(count, make_wanted, &jobs);
  } else {
    Workers(std::max(threads, 1u) - 1, Workers::Missing::done_without).run(count, make_wanted, &jobs);
  }
}

Status make_pipelines(GraphInstance::State& state, const Shaders& shaders, std::span<const Wanted> wanted) {
  PipelineJobs jobs{state.context, shaders, state.objects, wanted, std::vector<Status>(wanted.size(), Status(Done{}))};
  run_jobs(state, jobs);
  const uint32_t failed = jobs.first_failed.load();
  return failed == UINT32_MAX ? Status(Done{}) : jobs.results[failed];
}

// ---- passes -----------------------------------------------------------------------------------------------------------

Status create_attachments(const Context& context, const Pass& pass, PassObjects& out) {
  const Rendering& rendering = context.plan.renderings[pass.rendering];
  out.bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  for (const Attachment& attachment : context.plan.attachments.subspan(rendering.first_color, rendering.color_count))
    out.color_formats.push_back(attachment.ref.resource == kNone ? VK_FORMAT_UNDEFINED
                                : attachment.view_format != Format::undefined
                                    ? static_cast<VkFormat>(attachment.view_format)
                                    : static_cast<VkFormat>(context.plan.resources[attachment.ref.resource].format));
  if (!context.device.classic_render_passes) return Done{};
  const Index index = static_cast<Index>(&pass - context.plan.passes.data());
  Result<UniqueRenderPass> render_pass = create_render_pass(context, index, out.part);
  if (!render_pass) return render_pass.error();
  out.render_pass = std::move(*render_pass);
  if (!out.part.first || out.part.last) return Done{};
  Result<UniqueRenderPass> whole = create_render_pass(context, index, {});
  if (!whole) return whole.error();
  out.whole_render_pass = std::move(*whole);
  return Done{};
}

// All but the pipelines.
Status create_one(const Context& context, const Objects& objects, const Pass& pass, uint32_t module_number, PassObjects& out) {
  out.name = pass.name;
  out.module = pass.module;
  out.module_number = module_number;
  if (pass.rendering != kNone) RG_TRY(create_attachments(context, pass, out));
  if (pass.binding_count != 0) {
    Result<UniqueSetLayout> layout = create_set_layout(context, context.plan.bindings.subspan(pass.first_binding, pass.binding_count), pass.name);
    if (!layout) return layout.error();
    out.set_layout = std::move(*layout);
  }
  out.label.sType = out.module_label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  out.label.pLabelName = out.name.c_str(), out.module_label.pLabelName = out.module.c_str();
  return create_layout(context, objects, pass, out);
}

// By pass, so that recording compares numbers and not names.
std::vector<uint32_t> module_numbers(const Plan& plan) {
  std::vector<std::string_view> modules = {{}};
  std::vector<uint32_t> numbers;
  for (const Pass& pass : plan.passes) {
    const auto known = std::find(modules.begin(), modules.end(), pass.module);
    numbers.push_back(static_cast<uint32_t>(known - modules.begin()));
    if (known == modules.end()) modules.push_back(pass.module);
  }
  return numbers;
}

}  // namespace

Status create_pass_objects(GraphInstance::State& state, const Predecessor* before) {
  static_assert(kPassSet == 1);
  const Context& context = state.context;
  Objects& objects = state.objects;
  Result<UniqueSetLayout> empty = create_set_layout(context, {}, context.plan.name);
  if (!empty) return empty.error();
  objects.empty_set_layout = std::move(*empty);
  objects.passes.resize(context.plan.passes.size());
  Shaders shaders(context.plan.shaders.size());
  const PipelineReuse reuse(context, before);
  const std::vector<uint32_t> modules = module_numbers(context.plan);
  const std::vector<RenderingPart> parts = find_parts(context.plan);
  std::vector<Wanted> wanted;
  for (Index p = 0; p < context.plan.passes.size(); ++p) {
    objects.passes[p].part = parts[p];
    RG_TRY(create_one(context, objects, context.plan.passes[p], modules[p], objects.passes[p]));
    RG_TRY(list_pipelines(context, p, reuse, shaders, objects.passes[p], wanted));
  }
  RG_TRY(make_pipelines(state, shaders, wanted));
  for (Index p = 0; p < context.plan.passes.size(); ++p) choose_pipelines(context, context.plan.passes[p], objects.passes[p]);
  return Done{};
}

}  // namespace rg
