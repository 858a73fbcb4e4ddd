// Correct little frames; tests of hazards break them on purpose.
#pragma once

#include <bit>

#include "tests/unit/runtime/shaders.h"
#include "tests/unit/runtime/test_plan.h"

namespace rg::test {

inline constexpr uint32_t kVertexBit = 1, kFragmentBit = 16, kComputeBit = 32;

inline Binding buffer_binding(uint32_t number, Ref buffer) {
  Binding binding;
  binding.binding = number, binding.type = DescriptorType::storage_buffer, binding.stages = kComputeBit, binding.ref = buffer;
  return binding;
}
inline Binding params_binding(uint32_t number, Index params) {
  Binding binding;
  binding.binding = number, binding.type = DescriptorType::uniform_buffer_dynamic, binding.stages = kComputeBit, binding.params = params;
  return binding;
}

// target[i] = source[i] + step
Index add_shader_pass(TestPlan& p, std::string_view name, Ref source, Ref target, Index groups);

// state = state.prev(1) + step; copied to `result`. Starts at 7.
//   group 0: state.prev was written by the last frame; state was written, read and copied by the frames before
//   group 1: state -> copy      group 2: result -> host
struct Counter {
  TestPlan plan;
  Index state = 0, result = 0, step = 0;
};
Counter counter();

Index one_color_rendering(TestPlan& p, Index image, Index width, Index height, LoadOp load, ClearValue clear);

// scene is cleared by a raster pass that a callback records; tint samples it into final, red and green swapped; final is copied to result.
//   groups: 0 scene discarded  1 scene -> sampled, final discarded  2 final -> copy  3 result -> host
struct Tint {
  TestPlan plan;
  Index scene = 0, final = 0, result = 0, draw = 0, tint = 0;
};
Tint tint();

// Three queues hand a value on: the transfer queue uploads `given`, the compute queue writes sum = given + step and clears `picture`, the graphics
// queue copies both to the host. Every queue waits for the readers of the frame before.
//   groups: 0 picture discarded  1 picture released  2 picture acquired  3 results -> host
enum RelayWait : Index { kGivenWasRead, kGivenIsThere, kResultsWereRead, kSumIsThere };  // in Plan::waits
struct Relay {
  TestPlan plan;
  Index given = 0, sum = 0, picture = 0, result_sum = 0, result_picture = 0;
};
Relay relay();

// Mips 1 to 3 of an image are cleared one pass each, mip m to the value m; the last existing one is not known before.
struct Mips {
  TestPlan plan;
  Index image = 0;
};
Mips mips();

// a is cleared and copied to result_a, then b, whose bytes may be a's, to result_b.
//   groups: 0 a discarded  1 a -> copy  2 b discarded  3 b -> copy  4 results -> host
struct Aliased {
  TestPlan plan;
  Index a = 0, b = 0, result_a = 0, result_b = 0;
};
Aliased aliased();

// a and b are filled and copied to the host. What the fill of b needs not wait for, the copy of a does not wait for either: its barrier is split.
//   steps: 0 barriers  1 fill a  2 set a  3 fill b  4 await a  5 copy a  6 barriers of b  7 copy b  8 results -> host
struct Split {
  TestPlan plan;
  Index a = 0, b = 0, result_a = 0, result_b = 0;
};
inline constexpr Index kSplitGroup = 1, kSetStep = 2, kAwaitStep = 4;
Split split();

}  // namespace rg::test
