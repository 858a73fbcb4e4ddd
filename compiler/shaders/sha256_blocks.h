// The compression function of SHA-256: with the processor's instructions for it where it has them, else in portable code. All give the same state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rg::compiler {

using Sha256State = std::array<uint32_t, 8>;
using Sha256Blocks = void (*)(Sha256State& state, const uint8_t* data, size_t blocks);  // of 64 bytes each

void sha256_blocks_portable(Sha256State& state, const uint8_t* data, size_t blocks);
Sha256Blocks sha256_blocks_native();  // null: this processor, or this build, has none
Sha256Blocks sha256_blocks();         // the faster one

}  // namespace rg::compiler
