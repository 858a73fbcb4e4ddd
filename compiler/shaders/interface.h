// The interface of a pass as its shaders see it: descriptor bindings of set 1, and the GLSL text put in front of a shader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsl/program.h"

namespace rg::compiler {

enum class BindingKind : uint8_t {
  combined_sampler,
  texture,
  storage_image,
  storage_buffer,
  uniform_buffer,
  params,
  texel_buffer,
  storage_texel_buffer
};

// One descriptor of set 1. Numbers follow Pass::accesses, then Pass::params; an access no shader can see has none.
//
//   read   depth as sampled         binding 0   texture
//   color  hdr                      -
//   atomic tile_mask                binding 1   storage_buffer
//   params view_constants           binding 2   params
struct InterfaceBinding {
  BindingKind kind = BindingKind::texture;
  uint32_t binding = 0;
  uint32_t access = dsl::kAll;  // index into Pass::accesses, or
  uint32_t params = dsl::kAll;  // index into Pass::params
  std::string name;
  dsl::Span span;  // of the declaration
};
std::string last_part(const std::string& name);  // `tiles` of `lamps.tiles`
// What shaders call the descriptor of an access: its name, but for elements, whose name is that of a variable.
std::string binding_name(const dsl::Access& access);
std::vector<InterfaceBinding> pass_bindings(const dsl::Program& program, const dsl::Graph& graph, const dsl::Pass& pass);

// The view an access makes of its image: a range of one layer of an array is not an array, one of a cube's faces is 2D.
struct ViewShape {
  dsl::Dimension dimension = dsl::Dimension::d2;
  bool arrayed = false;
  uint32_t aspects = 1;  // exactly one aspect: depth wins where both are there
};
ViewShape view_shape(const dsl::Resource& image, const dsl::Access& access);

// Each line remembers the declaration it comes from, so that a name GLSL refuses is reported there.
struct PreludeLine {
  std::string text;
  dsl::Span origin;
};
using Prelude = std::vector<PreludeLine>;
// The number of the specialisation constant of Pass::features[i] is this plus i.
constexpr uint32_t kFirstFeatureConstant = 1000;
// `fixed`, by Pass::features: the value of a feature that the preprocessor sees; none: a specialisation constant. Empty: all of them.
using FixedFeatures = std::vector<std::optional<uint32_t>>;
Prelude make_prelude(const dsl::Program& program, const dsl::Graph& graph, const dsl::Pass& pass, dsl::Stage stage, const FixedFeatures& fixed = {});
// The name of a feature in preprocessor lines: FEATURE_fog is 0 or 1, or the number of its value.
std::string feature_macro(const dsl::ShaderFeature& feature);
std::string text(const Prelude& prelude);

// The engine set `pass.bind` names, or null.
const dsl::EngineSet* engine_set_of(const dsl::Program& program, const dsl::Pass& pass);
// The declarations of an engine set, each with its set and binding number in front.
std::vector<std::string> engine_set_declarations(const dsl::EngineSet& set);

// One triangle that covers the target; gives `vec2 uv` at location 0, (0, 0) at the upper left.
extern const char* const kFullscreenVertexShader;
bool is_fullscreen(const dsl::Pass& pass);

}  // namespace rg::compiler
