// The greatest weight that can be alive at once where "before" is a partial order instead of a line, as it is on several queues.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

namespace rg::compiler {

// Max-weight antichain of the order that `edges` (before, after) generate over nodes of weight >= 0; a node of weight 0 only carries order.
// Weighted Dilworth: sum of weights - maximum flow on the split graph (Möhring, "Algorithmic aspects of comparability graphs and interval graphs",
// 1985), the flow by Dinic's method. Pre-condition: the edges have no cycle. For one queue this is the greatest load over time.
// Cost: O(V^2 E) at worst over the edges that no two others imply; to find these, O(V E / 64). Near that on the orders of frames.
uint64_t max_weight_antichain(std::span<const uint64_t> weights, std::span<const std::pair<uint32_t, uint32_t>> edges);

}  // namespace rg::compiler
