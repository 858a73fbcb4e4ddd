// Blocks to kernels. A block is GLSL for one element of its pass's domain; what the pass declares `as element` are variables that hold the
// element's value: loaded before, stored afterwards.
//
//   void element(ivec2 at)                    for every element; `int at` and `ivec3 at` on one and three axes
//
// A block with `scan z T` carries a T along z, from near to far:
//
//   T    start(ivec3 at)                      before the first element of a line
//   void element(ivec3 at, inout T carried)
//
// and with `scan z T associative`, so that stretches of a line may be summed up side by side:
//
//   T    start(ivec3 at)
//   T    own(ivec3 at)                        what the element adds
//   T    join(T near, T far)                  associative
//   void element(ivec3 at, T carried)         with everything up to and with itself
//
// domain_size() is the number of elements along each axis. One block makes an ordinary compute pass. Several make one kernel that runs them one after
// the other for each element: what one writes and a later one reads stays in a register, converted as its format would have; what several read is
// loaded once.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compiler/fusion/conversions.h"
#include "compiler/fusion/glsl_text.h"
#include "dsl/program.h"

namespace rg::compiler {

struct KernelMember {
  dsl::PassId pass;
  FlatSource source;  // of its block
};
struct KernelOrder {
  std::string name;                   // of the pass it becomes
  std::vector<KernelMember> members;  // in order; passes with blocks over one domain
  std::set<dsl::ResourceId> dropped;  // written first by a member, read by members only: stay in registers
  bool unrounded = false;             // dropped values keep all their bits
  HalfRounding halves = HalfRounding::zero;
};
// An ordinary compute pass with the shader's text in it. Everything but name, accesses, parameters, features, dispatch and shader is the first
// member's.
dsl::Pass write_kernel(dsl::Program& program, const dsl::Graph& graph, const KernelOrder& order);

// Elements side by side along each axis of the kernel's group.
struct GroupShape {
  uint32_t size[3] = {1, 1, 1};
};
GroupShape group_of(const std::vector<const dsl::Pass*>& members);
// Workgroup memory the kernel takes, bytes.
uint64_t shared_bytes(const dsl::Program& program, const std::vector<const dsl::Pass*>& members);

// Two accesses that mean the same element value.
bool same_cell(const dsl::Access& a, const dsl::Access& b);

}  // namespace rg::compiler
