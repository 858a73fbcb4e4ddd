// Which raster passes are one rendering: begun and ended once, so that attachments stay on the chip and no barrier stands between.
//
//   pass       gbuffer_world          gbuffer_props            a rendering of its own each: store, barrier, load between them
//   color      albedo clear           albedo
//   depth      depth  clear           depth
//   becomes    [ gbuffer_world          gbuffer_props ]        one rendering: clear, draw, draw, store
//
// Passes of one rendering have the same attachments, follow each other without anything between, and depend on each other through attachments only,
// which rasterization order keeps (Vulkan, "Rasterization Order"). Only the first clears, only the last resolves, and none runs where the first is
// skipped. Every dependency path between two of them stays inside. A pass that only reads depth uses it in the layout of those that write it.
//
// Merging costs no memory: a merge after which program order, cut greedily, would need more bytes is not made. Other orders are tried with and
// without those that stand where the most is live, see plan_frame.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/build_graph.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Renderings {
  std::vector<uint32_t> leader_of;  // by pass of the frame: the first of its rendering; itself where it is alone
  Decisions decisions;              // of passes that continue a rendering, or could if something were different
  struct NewLayout {
    size_t use = 0;  // index of Frame::uses
    Layout layout = Layout::undefined;
  };
  std::vector<NewLayout> layouts;  // what passes that read depth have to use
};

// Every pass for itself.
Renderings separate_renderings(const Frame& frame);

// O(attachments + dependencies) log n, and for each pass with the attachments of an earlier one at most 4096 passes between them. Changes nothing;
// whoever applies `layouts` builds the graph again and asks again. `apart`: passes that begin a rendering of their own, ascending.
Renderings find_renderings(const Frame& frame, const Graph& graph, const std::vector<bool>& live, const PlanOptions& options,
                           const std::vector<uint32_t>& apart = {});

}  // namespace rg::compiler
