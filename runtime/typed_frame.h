// What the frame class of every graph offers beside its typed calls: base of the generated classes, see docs/generated.md.
//
// Passes and resources are named by the constants of the generated header (`frame::pass::x`, `frame::resource::y`). After a reload they are looked up
// by name in the plan that runs now, so they keep their meaning.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/graph.h"
#include "runtime/plan_file.h"

namespace rg {

// Ownership and threads as GraphInstance. Not copyable; an object that was moved from is only destroyed or assigned to.
class TypedFrame {
 public:
  // The next frame runs the plan of this graph and configuration in `file`, which is kept. History and persistent resources of the same name and
  // shape go on. Refused whole, with the reason, where the program would have to be compiled again (see check_interface) or an object cannot be made:
  // the old plan goes on. Waits for nothing; the instance before is destroyed when its frames are done. PassInfo changes: what an engine built from
  // it, it builds again.
  Status reload(const PlanFile& file);
  // The same plan with other threads, frames in flight or debugging; contents go on. Extents stay; engine set layouts too where `options` has none.
  Status reconfigure(GraphOptions options);
  // The next frame of this graph follows the last one of `other`, another configuration of it; see GraphInstance::continue_from.
  Status continue_from(TypedFrame& other);

  // Before its next use the history or persistent resource is set to its declared initial value again; see GraphInstance::invalidate.
  Status invalidate(Index resource);
  bool history_valid(Index resource) const;  // see GraphInstance::history_valid

  // See the functions of these names in runtime/graph.h.
  Status use_commands(std::span<const OwnCommands> parts, const FrameDone& done);  // passes by the generated names
  // As GraphInstance::use_semaphores.
  Status use_semaphores(std::span<const SemaphoreUse> waits, std::span<const SemaphoreUse> signals);
  // As the functions of GraphInstance.
  Status wait_idle() { return instance_.wait_idle(); }
  // As GraphInstance::frame.
  uint64_t frame() const { return instance_.frame(); }
  // As GraphInstance::memory.
  MemoryReport memory() const { return instance_.memory(); }
  // An empty one where a reloaded plan has no such pass; never for passes that the host records.
  const PassInfo& pass_info(Index pass) const;

  // Looking inside: times of the last finished frame, the same as `rgc --profile` reads it, and resources as they are after a pass.
  std::vector<PassTime> pass_times() { return instance_.pass_times(); }
  // As GraphInstance::pass_statistics.
  std::vector<PassStatistics> pass_statistics() { return instance_.pass_statistics(); }
  std::string profile_json();  // see profile.h
  // As GraphInstance::request_dump.
  Status request_dump(Index pass, Index resource, uint32_t mip = 0);
  // As GraphInstance::take_dump.
  Result<Dump> take_dump() { return instance_.take_dump(); }

  // The plan that runs now: the generated one, or the last reloaded.
  const Plan& running_plan() const { return instance_.plan(); }
  // The untyped instance; another object's after a move, another instance after a reload.
  GraphInstance& instance() { return instance_; }

 protected:
  // `built`: the generated plan, of which `instance` runs this or a reloaded one.
  TypedFrame(const Plan& built, GraphInstance instance, const GraphOptions& options);
  // For create_successor of generated classes.
  static Result<GraphInstance> succeed(TypedFrame& current, const Plan& plan, const GraphOptions& options);
  // For the generated execute.
  Status execute_inputs(const FrameInputs& inputs) {
    const Status done = instance_.execute(inputs);
    if (!retired_.empty()) [[unlikely]]
      let_go();
    return done;
  }
  // For the generated resize.
  Status resize_to(std::span<const int64_t> extents) { return instance_.resize(extents); }
  // For the generated set_active.
  Status set_active_to(std::span<const int64_t> extents) { return instance_.set_active(extents); }
  // For the generated accessors.
  Result<std::span<const std::byte>> read_back(Index resource);

 private:
  struct Retired {
    GraphInstance instance;
    std::optional<PlanFile> file;
    uint64_t until = 0;  // frames executed, after which nothing of it can be in flight
  };
  Status replace(const Plan& plan, const GraphOptions& options, std::optional<PlanFile> file);
  void keep_options(const GraphOptions& options);
  void let_go();
  Index pass_now(Index built) const;
  Index resource_now(Index built) const;
  Error gone(std::string_view kind, std::string_view name) const;

  const Plan* built_;
  GraphOptions options_;  // of the last creation, pointing into what follows
  std::vector<VkDescriptorSetLayout> engine_set_layouts_;
  std::optional<PlanFile> file_;  // of the plan that runs now; none: the generated one
  GraphInstance instance_;
  std::vector<Retired> retired_;
};

}  // namespace rg
