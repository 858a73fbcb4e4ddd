// The checker of folding: it accepts what means the same, and rejects every fold that does not.
#include "compiler/verify/folding.h"

#include <gtest/gtest.h>

#include <functional>

#include "compiler/fold_transfers.h"
#include "compiler/machine/machine.h"
#include "dsl/front_end.h"
#include "tests/unit/verify/random_program.h"

namespace rg::verify {
namespace {

constexpr dsl::GraphId kFrame{size_t{0}};

dsl::Program read_program(const std::string& body) {
  const std::string text =
      "module test\nextent view = runtime(64, 64) max(128, 128)\ncondition sometimes\n"
      "graph frame(surface backbuffer: rgba8 view after copy_src) {\n" +
      body + "}\n";
  dsl::Diagnostics diagnostics;
  const auto read = [&](const std::string&, std::string&) { return std::optional<std::string>(text); };
  dsl::FrontEndResult result = dsl::load_program("test.rg", read, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << dsl::print(diagnostics, result.files, false);
  return std::move(result.program);
}

const std::string kImages =
    "image many : rgba8 view samples 4\n image one : rgba8 view\n image side : rgba8 view\n"
    "pass old : raster { color one clear 1  draw host {} }\n pass seen : compute { read one as sampled  write side as storage }\n";
const std::string kWipe = "pass wipe : transfer { clear many 0.5 }\n", kFlatten = "pass flatten : transfer { resolve many -> one }\n";
const std::string kShow =
    "pass show : raster { read one as sampled in fragment  read side as sampled in fragment  color backbuffer covers  draw host {} }\n";
std::string draw(const std::string& rest) { return "pass draw : raster { color many" + rest + "  draw host {} }\n"; }

std::string hazards(const dsl::Program& apart, const dsl::Program& folded) {
  std::string text;
  for (const Finding& finding : verify_folding(apart, folded, kFrame, std::vector<uint32_t>(apart.features.size(), 0)))
    text += std::string(name(finding.hazard)) + " " + finding.resource + ": " + finding.text + "\n";
  return text;
}
// Of two texts, whose passes stand at different places.
dsl::Program read_without_places(const std::string& body) {
  dsl::Program program = read_program(kImages + body + kShow);
  for (dsl::Pass& pass : program.graphs.rows[0].passes) {
    pass.span = {};
    for (dsl::Access& access : pass.accesses) access.span = {};
  }
  return program;
}
std::string between(const std::string& apart, const std::string& folded) { return hazards(read_without_places(apart), read_without_places(folded)); }

TEST(Folding, WhatMeansTheSameIsAccepted) {
  EXPECT_EQ(between(kWipe + draw("") + kFlatten, draw(" clear 0.5  resolve many -> one")), "");
  EXPECT_EQ(between(kWipe + draw("") + kFlatten, draw(" clear 0.5") + kFlatten), "");
  EXPECT_EQ(
      between("if host sometimes { " + kWipe + draw("") + kFlatten + "}\n", "if host sometimes { " + draw(" clear 0.5  resolve many -> one") + "}\n"),
      "");
  EXPECT_EQ(between("image maps : d32f_s8 64x64\n pass wipe : transfer { clear maps (1, 0) }\n pass solid : raster { depth maps  stencil maps  draw "
                    "host {} }\n",
                    "image maps : d32f_s8 64x64\n pass solid : raster { depth maps clear 1.0  stencil maps clear 0  draw host {} }\n"),
            "");
}

struct Wrong {
  std::string apart, folded, finding;
};
TEST(Folding, WhatDoesNotIsRejected) {
  const std::string both = kWipe + draw("") + kFlatten, late = "pass late : raster { color many  draw host {} }\n";
  const std::string dots = "pass dots : raster { color maps  draw host {} }\n", paint = "pass paint : raster { color maps";
  const std::string layers = "image maps : rgba8 64x64 layers 2 persistent init clear 0\n",
                    layer = "pass wipe : transfer { clear maps.layer(0) 1 }\n";
  const Wrong rows[] = {
      {both, draw(" clear 0.25  resolve many -> one"), "wrong version many: `draw` sees a clear in `many`, and a clear as written\n"},
      {both, draw(" clear 0.5"), "wrong version one: `show` sees `old` in `one`, and a resolve of `draw` as written\n"},
      {kWipe + draw("") + late + kFlatten, draw(" clear 0.5  resolve many -> one") + late,
       "wrong version one: `show` sees a resolve of `draw` in `one`, and a resolve of `late` as written\n"},
      {layers + "pass wipe : transfer { clear maps 1 }\n" + dots + paint + "  draw host {} }\n", layers + dots + paint + " clear 1  draw host {} }\n",
       "wrong version maps: `dots` sees what was there before the frame in `maps`, and a clear as written\n"
       "wrong version maps: `paint` sees a clear in `maps`, and `dots` as written\n"},
      {both + "pass again : raster { color one  draw host {} }\n", draw(" clear 0.5") + "pass again : raster { color one  draw host {} }\n",
       "wrong version one: `again` sees `old` in `one`, and a resolve of `draw` as written\n"},
      {layers + "pass wipe : transfer { clear maps 1 }\n pass paint : raster { color maps.layer(0)  draw host {} }\n",
       layers + "pass paint : raster { color maps.layer(0) clear 1  draw host {} }\n",
       "wrong version maps: `maps` ends as what was there before the frame, and as a clear as written\n"},
      {layers + layer + "pass paint : raster { color maps.layer(1)  draw host {} }\n",
       layers + "pass paint : raster { color maps.layer(1) clear 1  draw host {} }\n",
       "wrong version maps: `paint` sees a clear in `maps`, and what was there before the frame as written\n"
       "wrong version maps: `maps` ends as what was there before the frame, and as a clear as written\n"},
      {layers + "pass wipe : transfer { clear maps 1 }\n if host sometimes { pass paint : raster { color maps  draw host {} } }\n",
       layers + "if host sometimes { pass paint : raster { color maps clear 1  draw host {} } }\n",
       "wrong version maps: `maps` ends as `paint` under conditions, and as `paint` under conditions as written\n"
       "wrong version maps: `maps` ends as `paint` under conditions, and as `paint` under conditions as written\n"},
      {"pass wipe : transfer queue compute { clear many 0.5 }\n" + draw("") + kFlatten, draw(" clear 0.5  resolve many -> one"),
       "submission : `wipe` is gone from the queue that it orders\n"},
      {"pass wipe : transfer { clear many 0.5  keep }\n" + draw("") + kFlatten, draw(" clear 0.5  resolve many -> one"),
       "missing pass : `wipe` is gone, though it is to be kept\n"},
      {kWipe + draw("") + "pass flatten : transfer { resolve many -> one  after seen }\n", draw(" clear 0.5  resolve many -> one"),
       "order : `flatten` is gone, though it comes `after` `seen`\n"},
      {both, "pass draw : raster { color many clear 0.5  resolve many -> one  draw host {}  after seen }\n",
       "order : `draw` comes after other passes than as written\n"},
      {"pass make : compute { write side as storage }\n" + both, draw(" clear 0.5  resolve many -> one"),
       "missing pass : `make` is gone, and does more than to clear and resolve\nwrong version side: `show` sees `seen` in `side`, and `make` as "
       "written\n"},
  };
  for (const Wrong& row : rows) EXPECT_EQ(between(row.apart, row.folded), row.finding) << row.apart << "becomes\n" << row.folded;
}

// What no program of the language can say, made by hand.
TEST(Folding, AttachmentsThatCannotAreRejected) {
  const auto edited = [](const std::function<void(dsl::Graph&)>& edit) {
    const std::string text = kImages + kWipe + draw("") + kFlatten + kShow;
    dsl::Program apart = read_program(text), folded = compiler::fold_transfers(apart, {}).program;
    edit(folded.graphs.rows[0]);
    return hazards(apart, folded);
  };
  const auto pass_draw = [](dsl::Graph& graph) -> dsl::Pass& {
    return *std::find_if(graph.passes.begin(), graph.passes.end(), [](const dsl::Pass& pass) { return pass.name == "draw"; });
  };
  EXPECT_EQ(edited([](dsl::Graph&) {}), "");
  EXPECT_NE(edited([&](dsl::Graph& graph) { pass_draw(graph).accesses[0].view = dsl::Format::rgba8_srgb; }).find("uses `many` in another way"),
            std::string::npos);
  EXPECT_NE(edited([&](dsl::Graph& graph) { pass_draw(graph).accesses[1].range.mip = 1; }).find("cannot resolve `many` to `one`"), std::string::npos);
  EXPECT_NE(edited([&](dsl::Graph& graph) { pass_draw(graph).accesses[0].mode = dsl::Mode::update; }).find("uses `many` in another way"),
            std::string::npos);
  EXPECT_NE(edited([&](dsl::Graph& graph) { pass_draw(graph).conditions.push_back(dsl::ConditionId{size_t{0}}); }).find("is another pass"),
            std::string::npos);
  EXPECT_NE(edited([&](dsl::Graph& graph) { std::swap(graph.passes.rows.back(), *(graph.passes.rows.end() - 2)); }).find("is not where it was"),
            std::string::npos);
}

}  // namespace
}  // namespace rg::verify
