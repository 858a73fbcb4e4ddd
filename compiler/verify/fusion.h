// Kernels against the blocks they were made from: the program whose blocks became kernels has to mean what the program as written means.
//
// Both programs run in order, for one choice of features, over locations (an aspect, mip and layer of an image; a buffer) that hold versions: who
// wrote last. A kernel runs its members one after the other. Then
//   * every read of every block sees the version that it sees in the program as written;
//   * every access of a block is made by its kernel, with the rights it needs, and no kernel makes an access that no block of it makes;
//   * what a kernel keeps to itself is read by nobody else and outlives no frame;
//   * where one member writes what another touches, both do so as elements of one domain, or both by atomic operations;
//   * members run under the same features and conditions, on the same queue, and scan along one axis;
//   * what outlives the frame has the same version at its end.
#pragma once

#include <string>
#include <vector>

#include "compiler/verify/verify.h"

namespace rg::verify {

struct Kernel {
  std::string pass;                  // of the program with kernels
  std::vector<std::string> members;  // of the program as written
};
// `kernels` says which passes hold several blocks; all others are their own. O(passes * accesses * subresources).
std::vector<Finding> verify_fusion(const dsl::Program& written, const dsl::Program& fused, dsl::GraphId graph,
                                   const std::vector<uint32_t>& configuration, const std::vector<Kernel>& kernels);

}  // namespace rg::verify
