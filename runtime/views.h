// Image views for bindings and attachments.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// What a view is for; the rest follows from the resource.
struct ViewRequest {
  Ref ref;
  Range range;
  Dimension dimension = Dimension::d2;
  bool arrayed = false;
  Format format = Format::undefined;  // undefined: the image's own
  VkImageUsageFlags usage = 0;
  uint32_t slice = 0, slices = 0;  // of a 3D image as an attachment; 0 slices: the whole
  bool all_aspects = false;        // attachments of a depth and stencil image share one view
};

// Creates one view for each physical copy, or a slot for views of an import. `exists` is false where the range has vanished.
Result<ViewRef> create_views(const Context& context, Sized& sized, const ViewRequest& request);

// Makes `current` of every imported view fit this frame's imports. Creates a view where an image is seen for the first time.
Status update_imported_views(const Context& context, Sized& sized, const std::vector<Import>& imports, uint64_t frame);

}  // namespace rg
