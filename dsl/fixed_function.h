// What the language says of samplers, blending and the fixed stages of the graphics pipeline.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsl/source.h"

namespace rg::dsl {

enum class Filter : uint8_t { nearest, linear };
enum class AddressMode : uint8_t { repeat, mirror, clamp, border };
enum class Compare : uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
struct Sampler {
  std::string name;
  Filter filter = Filter::nearest, mip_filter = Filter::nearest;
  AddressMode address = AddressMode::clamp;
  std::optional<Compare> compare;
  float max_anisotropy = 0;  // 0: off
  Span span;
  friend bool operator==(const Sampler&, const Sampler&) = default;
};

enum class BlendFactor : uint8_t {
  zero,
  one,
  src_alpha,
  one_minus_src_alpha,
  dst_alpha,
  one_minus_dst_alpha,
  src_color,
  one_minus_src_color,
  dst_color,
  one_minus_dst_color,
};
enum class BlendOp : uint8_t { add, subtract, reverse_subtract, min, max };
struct Blend {  // of one colour attachment; disabled unless declared on it
  bool enabled = false;
  BlendOp op = BlendOp::add;
  BlendFactor src = BlendFactor::one, dst = BlendFactor::zero;
  BlendFactor src_alpha = BlendFactor::one, dst_alpha = BlendFactor::zero;
  friend bool operator==(const Blend&, const Blend&) = default;
};
enum class Cull : uint8_t { none, front, back };
enum class Topology : uint8_t { points, lines, triangles, triangle_strip };
enum class StencilOp : uint8_t { keep, zero, replace, increment, decrement, invert, increment_wrap, decrement_wrap };
struct StencilFace {  // what the triangles that face one way do to stencil
  Compare compare = Compare::always;
  StencilOp fail = StencilOp::keep, depth_fail = StencilOp::keep, pass = StencilOp::keep;
  uint8_t read_mask = 255, write_mask = 255;  // the latter only where the pass may write stencil
  uint8_t reference = 0;
  friend bool operator==(const StencilFace&, const StencilFace&) = default;
};
struct SampleLocation {
  float x = 0, y = 0;  // from the upper left corner
  friend bool operator==(const SampleLocation&, const SampleLocation&) = default;
};
struct State {
  std::string name;
  Cull cull = Cull::back;
  bool front_clockwise = false;
  bool depth_test = false;
  Compare depth_compare = Compare::greater_equal;
  bool depth_write = true;  // only where the pass may write depth
  float depth_bias_constant = 0, depth_bias_slope = 0;
  Topology topology = Topology::triangles;
  bool alpha_to_coverage = false;
  bool stencil_test = false;
  StencilFace stencil_front, stencil_back;
  // What not every device has: it holds in those variants of a pass in which a feature of the pass says that the device does.
  bool depth_bounds = false;
  float depth_min = 0, depth_max = 1;
  bool conservative = false;
  std::vector<SampleLocation> sample_locations;  // in the pixel, one a sample; empty: the device's own
  Span span;
  friend bool operator==(const State&, const State&) = default;
};

}  // namespace rg::dsl
