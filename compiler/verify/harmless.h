// Damage that changes nothing: the named classes of mutate(). Judged from program and plan, by rules that are not the checker's.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::verify {

// Each function names the class to which a damage belongs, or gives nothing where verify() has to object.
class Harmless {
 public:
  // All outlive it.
  Harmless(const dsl::Program& program, dsl::GraphId graph, const Plan& plan, const std::vector<uint32_t>& program_pass)
      : program_(program), graph_(program.graphs[graph]), plan_(plan), program_pass_(program_pass) {}

  // The barrier discards what it keeps now.
  static std::string without_contents(const ImageBarrier& barrier);
  // The barrier's second scope goes without a stage, or an access.
  std::string unseen(Index image_barrier, Stages stage, Accesses access) const;
  // The wait goes without a stage.
  std::string unwaited(Index wait, Stages stage) const;
  // The barrier's range goes without this subresource.
  std::string narrower(Index image_barrier, uint32_t mip, uint32_t layer) const;
  // The attachment does not store.
  std::string not_stored(Index attachment) const;
  // The release claims to stand a point earlier.
  std::string released_earlier(Index release) const;
  // A half of the split group is moved over these steps.
  std::string moved(Index group, Index first_step, Index last_step, bool sets) const;
  // The pass of this step and the next one change places.
  std::string exchanged(Index step) const;

 private:
  std::span<const Access> accesses_of(Index pass) const {
    return plan_.accesses.subspan(plan_.passes[pass].first_access, plan_.passes[pass].access_count);
  }
  bool names(const BarrierGroup& group, const Access& access, bool sources) const;
  bool is_waited_for(Index image_barrier, uint32_t mip, uint32_t layer) const;
  bool leads(Index from, Stages stages, Index to, Stages second) const;
  bool holds(const Step& step, Index image_barrier) const;
  bool moves(const BarrierGroup& group, const Ref& image, const Range& part) const;
  bool may_skip(Index pass, const Ref& image, uint32_t mip) const;
  bool leads_to_tests(const BarrierGroup& group, Stages from) const;
  bool is_cleared_first(const Pass& pass, bool may_clear, std::vector<Attachment>& cleared) const;
  bool is_cleared_first(Index image_barrier, uint32_t aspects) const;
  bool is_cleared_first(std::span<const Step>::iterator from, const Ref& image, const Range& spot) const;
  bool draws_to(const Pass& pass, Index attachment) const;
  bool leaves_layout(Index image_barrier, uint32_t mip, uint32_t layer) const;

  const dsl::Program& program_;
  const dsl::Graph& graph_;
  const Plan& plan_;
  const std::vector<uint32_t>& program_pass_;
};

}  // namespace rg::verify
