// Pipelines that a successor takes over instead of making them again: those whose code, fixed state, attachments and layouts are the same. After an
// edit of one shader that is all but a few.
#pragma once

#include <string_view>
#include <unordered_map>

#include "runtime/graph_state.h"

namespace rg {

// The instance that is succeeded, alive as long as this is used.
struct Predecessor {
  const Context& context;
  const Objects& objects;
};

class PipelineReuse {
 public:
  PipelineReuse(const Context& context, const Predecessor* before);
  // That of row `index` of Plan::pipelines, which `pass` has; null: there is none yet. `made`: its layouts and formats.
  SharedPipeline find(const Pass& pass, Index index, const PassObjects& made) const;

 private:
  const Context& context_;
  const Predecessor* before_;
  std::unordered_map<std::string_view, Index> passes_;  // of the predecessor, by name
};

}  // namespace rg
