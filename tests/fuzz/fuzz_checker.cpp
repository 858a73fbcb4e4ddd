// Any bytes as a root file beside modules that hold one of everything: the checker gives the same program again, and one that is whole.
#include "dsl/check_macro.h"
#include "dsl/features.h"
#include "dsl/front_end.h"
#include "dsl/print.h"

namespace {

using namespace rg::dsl;

constexpr const char* kParts =
    "module parts\n"
    "const TILE = 8\n"
    "private const HIDDEN = 3\n"
    "extent view = runtime(64, 64) min(8, 8) max(128, 128)\n"
    "struct Light { at: vec3  range: f32  weights: f32[3] }\n"
    "sampler linear { filter linear }\n"
    "sampler shadow { filter linear  compare greater_equal }\n"
    "state solid { cull none  depth test greater_equal }\n"
    "feature fog: bool\n"
    "feature path: { low, middle requires fog, high excludes fog }\n"
    "condition miss[4]\n"
    "set materials 2 { uniform sampler2D albedo[4]; }\n"
    "interface Scene { lights: buffer Light[] ready as storage in compute  maps: image bc7 64x64 layers 4 ready as sampled in fragment }\n"
    "technique blur(image source: rgba16f, inout image target, buffer weights: f32, const radius) {\n"
    "  image half : rgba16f source / 2\n"
    "  pass down : compute { read source as sampled(linear)  read weights as storage  write half as storage }\n"
    "  pass up : compute { read half as sampled(linear)  update target as storage }\n"
    "}\n";

FrontEndResult load(const std::string& text, Diagnostics& diagnostics) {
  return load_program(
      "fuzz.rg",
      [&](const std::string& path, std::string& why) -> std::optional<std::string> {
        if (path == "fuzz.rg") return text;
        if (path == "parts.rg") return kParts;
        why = "no such file";
        return std::nullopt;
      },
      diagnostics);
}

// Every id points at a row.
void expect_whole(const Program& program) {
  for (const Graph& graph : program.graphs) {
    for (const Pass& pass : graph.passes) {
      for (const Access& access : pass.accesses) RG_CHECK(access.resource.value < graph.resources.size(), "an access names a resource");
      for (const PassId other : pass.after) RG_CHECK(other.value < graph.passes.size(), "`after` names a pass");
      for (const ParamsUse& use : pass.params) RG_CHECK(use.id.value < graph.params.size(), "a pass names its parameters");
      for (const Guard::Term& term : pass.guard.terms)
        RG_CHECK(term.value < program.features[term.feature].values.size(), "a guard names a value of its feature");
    }
    for (const Resource& resource : graph.resources)
      for (const ExprId id : {resource.width, resource.height, resource.depth, resource.count})
        RG_CHECK(!id.valid() || id.value < program.exprs.size(), "a size is an expression");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 65536) return 0;
  const std::string text = "import \"parts.rg\"\n" + std::string(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics, again;
  const FrontEndResult once = load(text, diagnostics);
  const FrontEndResult twice = load(text, again);
  RG_CHECK(print_json(diagnostics, once.files) == print_json(again, twice.files), "diagnostics are a function of the text");
  print_sarif(diagnostics, once.files);
  if (diagnostics.has_errors()) return 0;
  RG_CHECK(once.program == twice.program, "the program is a function of the text");
  expect_whole(once.program);
  print_program(once.program);
  return 0;
}
