// Random programs that compute numbers: `.rg` text, GLSL, and what program order says the result is.
//
// Every texel of a subresource and every element of a buffer holds the same number, a hash of the pass that wrote it and of what that
// pass read. So the meaning of a program is a map from subresource to number, and a lost, stale or torn version shows as another number.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rg::test {

struct RandomFrame {
  std::map<std::string, std::string> files;     // "random.rg" and its shaders
  std::vector<std::vector<uint32_t>> expected;  // by frame: the number each probe must find everywhere
  std::vector<std::string> probes;              // "frame 2, i1.mip(0).layer(1) after p7": what each number is, for messages
};

// `frames` frames of a graph of about `passes` passes besides its probes. The same seed gives the same program.
RandomFrame make_random_frame(uint64_t seed, uint32_t passes, uint32_t frames);

}  // namespace rg::test
