#include "compiler/lazy_attachments.h"

namespace rg::compiler {

void mark_lazy(PlanData& plan) {
  constexpr uint32_t kAttachments = 0x10 | 0x20;  // VkImageUsageFlagBits: colour; depth and stencil
  for (Resource& resource : plan.resources)
    resource.lazy = resource.kind == ResourceKind::image && resource.lifetime == Lifetime::transient && resource.usage != 0 &&
                    (resource.usage & ~kAttachments) == 0;
  for (const Attachment& attachment : plan.attachments) {
    if (attachment.load == LoadOp::load || attachment.store == StoreOp::store) plan.resources[attachment.ref.resource].lazy = false;
    if (attachment.resolve.resource != kNone) plan.resources[attachment.resolve.resource].lazy = false;
  }
}

}  // namespace rg::compiler
