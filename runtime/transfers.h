// Copies, blits, clears, fills, updates and resolves: regions at creation, commands per frame.
#pragma once

#include "runtime/graph_state.h"

namespace rg {

// Regions of every transfer of `pass`, in plan order.
std::vector<TransferTable> create_transfers(const Context& context, const Sized& sized, const Pass& pass);

// Copies the host's bytes of every update into this frame's section of the ring. Fails where they do not fit their target.
Status write_updates(const Context& context, Sized& sized, const FrameInputs& inputs, uint64_t frame);

// The regions of copies, blits and resolves between images, at the image sizes that are set now. Transfers from and to buffers stay whole.
void resize_transfer(const Context& context, const Sized& sized, TransferTable& table);

void record_transfer(const Context& context, const Sized& sized, const std::vector<Import>& imports, const TransferTable& transfer,
                     VkCommandBuffer commands, uint64_t frame);

}  // namespace rg
