// Random graphs as `.rg` text: every kind of resource and access the machine knows, recorded by the host, so that no shader is needed.
#pragma once

#include <cstdint>
#include <string>

namespace rg::test {

// About `passes` passes besides those that make the result observable. The same seed gives the same text.
std::string make_random_program(uint64_t seed, uint32_t passes);

}  // namespace rg::test
