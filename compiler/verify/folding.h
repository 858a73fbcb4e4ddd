// Renderings that clear and resolve against the program in which passes of their own did: both have to mean the same.
//
// Both programs run in order, for one choice of features, over locations (an aspect, mip and layer of an image, a buffer) that hold terms: what was
// there before the frame, a pass, the clear of a value, the resolve of a term, or one term where conditions hold and another where not. Then
//   * passes that are in both are there in one order and differ in nothing but clears of attachments and resolves at their end;
//   * passes that are gone only clear and resolve, may run where renderings do, and are neither kept nor named by an `after`;
//   * every access sees the same term in both, an attachment that is cleared seeing the clear;
//   * what outlives the frame holds the same term at its end;
//   * a rendering resolves whole attachments of several samples to images of one, of the same format, seen as that, and no integers.
#pragma once

#include <vector>

#include "compiler/verify/verify.h"

namespace rg::verify {

// O(accesses * subresources) log n.
std::vector<Finding> verify_folding(const dsl::Program& apart, const dsl::Program& folded, dsl::GraphId graph,
                                    const std::vector<uint32_t>& configuration);

}  // namespace rg::verify
