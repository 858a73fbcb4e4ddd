#include "runtime/typed_frame.h"

#include "runtime/errors.h"
#include "runtime/plan_interface.h"
#include "runtime/profile.h"

namespace rg {

TypedFrame::TypedFrame(const Plan& built, GraphInstance instance, const GraphOptions& options) : built_(&built), instance_(std::move(instance)) {
  keep_options(options);
}

// Spans of the caller's do not outlive the call. Vectors keep their storage when a frame is moved.
void TypedFrame::keep_options(const GraphOptions& options) {
  engine_set_layouts_.assign(options.engine_set_layouts.begin(), options.engine_set_layouts.end());
  options_ = options;
  options_.extents = {};
  options_.engine_set_layouts = engine_set_layouts_;
}

Result<GraphInstance> TypedFrame::succeed(TypedFrame& current, const Plan& plan, const GraphOptions& options) {
  GraphOptions all = options;
  if (all.engine_set_layouts.empty()) all.engine_set_layouts = current.engine_set_layouts_;
  return GraphInstance::create_successor(current.instance_, plan, all);
}

Status TypedFrame::replace(const Plan& plan, const GraphOptions& options, std::optional<PlanFile> file) {
  const std::vector<VkDescriptorSetLayout> layouts(options.engine_set_layouts.begin(), options.engine_set_layouts.end());
  GraphOptions kept = options;
  kept.engine_set_layouts = layouts;  // `options` may be our own
  Result<GraphInstance> next = GraphInstance::create_successor(instance_, plan, kept);
  if (!next) return next.error();
  retired_.push_back({std::move(instance_), std::move(file_), next->frame() + 4});
  instance_ = std::move(*next);
  file_ = std::move(file);
  keep_options(kept);
  return Done{};
}

// The slots of four frames, the most in flight, have come round: each waited for a frame that came after everything of the old instance.
void TypedFrame::let_go() {
  std::erase_if(retired_, [&](const Retired& retired) { return instance_.frame() > retired.until; });
}

Status TypedFrame::reload(const PlanFile& file) {
  const Plan* plan = file.find(built_->name, built_->variant_name);
  if (plan == nullptr)
    return Error{ErrorCode::invalid_argument,
                 "the plan file has no plan of graph `" + std::string(built_->name) + "`" +
                     (built_->variant_name.empty() ? "" : ", configuration `" + std::string(built_->variant_name) + "`")};
  RG_TRY(check_interface(*built_, *plan));
  return replace(*plan, options_, file);
}

Status TypedFrame::reconfigure(GraphOptions options) {
  if (options.engine_set_layouts.empty()) options.engine_set_layouts = engine_set_layouts_;
  return replace(instance_.plan(), options, file_);
}

Status TypedFrame::continue_from(TypedFrame& other) { return instance_.continue_from(other.instance_); }

// ---- by the names of the generated plan ---------------------------------------------------------------------------

Index TypedFrame::pass_now(Index built) const {
  if (built >= built_->passes.size()) return kNone;
  return instance_.plan().passes.data() == built_->passes.data() ? built : find_pass(instance_.plan(), built_->passes[built].name);
}
Index TypedFrame::resource_now(Index built) const {
  if (built >= built_->resources.size()) return kNone;
  return instance_.plan().resources.data() == built_->resources.data() ? built : find_resource(instance_.plan(), built_->resources[built].name);
}

Error TypedFrame::gone(std::string_view kind, std::string_view name) const {
  return Error{ErrorCode::invalid_argument, "graph `" + std::string(built_->name) + "`: the plan that runs now has no " + std::string(kind) +
                                                (name.empty() ? "" : " `" + std::string(name) + "`")};
}

namespace {

template <class Row>
std::string_view name_at(std::span<const Row> rows, Index index) {
  return index < rows.size() ? rows[index].name : std::string_view();
}

}  // namespace

Status TypedFrame::invalidate(Index resource) {
  const Index now = resource_now(resource);
  return now == kNone ? Status(gone("resource", name_at(built_->resources, resource))) : instance_.invalidate(now);
}

bool TypedFrame::history_valid(Index resource) const {
  const Index now = resource_now(resource);
  return now != kNone && instance_.history_valid(now);
}

Status TypedFrame::use_commands(std::span<const OwnCommands> parts, const FrameDone& done) {
  if (!file_) return instance_.use_commands(parts, done);
  std::vector<OwnCommands> now(parts.begin(), parts.end());
  for (OwnCommands& part : now)
    if (part.last_pass != kNone) {
      const Index built = part.last_pass;
      part.last_pass = pass_now(built);
      if (part.last_pass == kNone) return gone("pass", name_at(built_->passes, built));
    }
  return instance_.use_commands(now, done);
}

Status TypedFrame::use_semaphores(std::span<const SemaphoreUse> waits, std::span<const SemaphoreUse> signals) {
  return instance_.use_semaphores(waits, signals);
}

const PassInfo& TypedFrame::pass_info(Index pass) const {
  static const PassInfo kNothing;
  const Index now = pass_now(pass);
  return now == kNone ? kNothing : instance_.pass_info(now);
}

std::string TypedFrame::profile_json() { return rg::profile_json(instance_); }

Status TypedFrame::request_dump(Index pass, Index resource, uint32_t mip) {
  const Index pass_index = pass_now(pass), resource_index = resource_now(resource);
  if (pass_index == kNone) return gone("pass", name_at(built_->passes, pass));
  if (resource_index == kNone) return gone("resource", name_at(built_->resources, resource));
  return instance_.request_dump(pass_index, resource_index, mip);
}

Result<std::span<const std::byte>> TypedFrame::read_back(Index resource) {
  const Index now = resource_now(resource);
  if (now == kNone) return gone("resource", name_at(built_->resources, resource));
  return instance_.readback(now);
}

}  // namespace rg
