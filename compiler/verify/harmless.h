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
  Harmless(const dsl::Graph& graph, const Plan& plan, const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource)
      : graph_(graph), plan_(plan), program_pass_(program_pass), program_resource_(program_resource) {}

  // The barrier discards what it keeps now.
  static std::string without_contents(const ImageBarrier& barrier);
  // The barrier's range goes without this subresource.
  std::string narrower(Index image_barrier, uint32_t mip, uint32_t layer) const;
  // The attachment does not store.
  std::string not_stored(Index attachment) const;
  // The release claims to stand a point earlier.
  std::string released_earlier(Index release) const;
  // The passes of two steps change places; none stands between them.
  std::string exchanged(Index first_step, Index second_step) const;
  // A half of the split group is moved over these steps.
  std::string moved(Index group, Index first_step, Index last_step, bool sets) const;

 private:
  std::span<const Access> accesses_of(Index pass) const {
    return plan_.accesses.subspan(plan_.passes[pass].first_access, plan_.passes[pass].access_count);
  }
  bool names(const BarrierGroup& group, const Access& access) const;
  bool draws_to(const Pass& pass, Index attachment) const;
  bool leaves_layout(Index image_barrier, uint32_t mip, uint32_t layer) const;
  bool depend(Index a, Index b, Index after) const;
  bool is_overwritten(Index a, Index b, const Access& x, const Access& y, Index after) const;
  bool needs_contents(Index pass, Ref ref) const;
  bool runs_always(Index pass) const;
  bool commutes_in(Index pass, Ref ref) const;
  bool is_read(Ref ref) const;

  const dsl::Graph& graph_;
  const Plan& plan_;
  const std::vector<uint32_t>& program_pass_;
  const std::vector<uint32_t>& program_resource_;
};

}  // namespace rg::verify
