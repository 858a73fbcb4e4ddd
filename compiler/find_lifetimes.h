// When each transient holds memory, counted in segments: passes with no barrier between them overlap.
//
//   segment      0        1        2          resource   lifetime
//   passes     gbuffer   light   tone map     albedo     [0, 2)
//   albedo      W         R       .           hdr        [1, 3)
//   hdr         .         W       R
#pragma once

#include <vector>

#include "compiler/epochs.h"
#include "compiler/frame.h"

namespace rg::compiler {

struct Lifetime {  // half-open in segments; begin == end: not a transient, or not used
  uint32_t begin = 0, end = 0;
  bool used() const { return begin < end; }
  friend bool operator==(const Lifetime&, const Lifetime&) = default;
};
using Lifetimes = std::vector<Lifetime>;  // by program resource

// `no alias` resources and all of them without aliasing live in every segment.
Lifetimes find_lifetimes(const Frame& frame, const Schedule& schedule, const std::vector<Line>& lines, const PlanOptions& options);

}  // namespace rg::compiler
