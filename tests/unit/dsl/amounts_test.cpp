// How much work takes and how large things are: counts, buffers, sizes at all extents, and what a pass may have but once.
#include <gtest/gtest.h>

#include "golden.h"

namespace rg::dsl {
namespace {

golden::Loaded load_one(const std::string& text) { return golden::load("test.rg", {{"test.rg", text}}); }

golden::Loaded loaded_graph(const std::string& items, const std::string& before = {}) {
  return load_one(before + "extent view = runtime(64, 64) min(1, 1) max(128, 128)\ngraph g(surface s: rgba8 view after copy_src) {\n" + items +
                  "\n}\n");
}

// Errors, with their first notes; nothing where all is well.
std::string errors_of(const golden::Loaded& loaded) {
  std::string all;
  for (const Diagnostic& each : loaded.diagnostics.rows()) {
    if (row(each.kind).severity != Severity::error) continue;
    all += std::string(row(each.kind).code) + " " + each.message() + "\n";
  }
  return all;
}

std::string of_draw(const std::string& work, const std::string& before = {}) {
  return errors_of(loaded_graph(before + "pass p : raster { shader \"a.vert\" \"a.frag\"  color s clear 0  " + work + " }"));
}

TEST(Amounts, ADrawCountsFromOne) {
  EXPECT_EQ(of_draw("draw -3"), "RG0494 pass `p` draws -3 vertices, and 1 is the least\n");
  EXPECT_EQ(of_draw("draw 0"), "RG0494 pass `p` draws 0 vertices, and 1 is the least\n");
  EXPECT_EQ(of_draw("draw 3 instances 0"), "RG0494 pass `p` draws 0 instances, and 1 is the least\n");
  EXPECT_EQ(of_draw("draw 3 first -1"), "RG0494 pass `p` begins at vertex -1, and 0 is the least\n");
  EXPECT_EQ(of_draw("draw view.x - 2"), "RG0494 pass `p` draws -1 vertices, and 1 is the least\n");
  EXPECT_EQ(of_draw("draw view.x / 2"), "") << "nothing is drawn at the least extents";
  EXPECT_EQ(of_draw("draw 3 instances 1 first 0"), "");
  EXPECT_EQ(errors_of(loaded_graph("pass p : compute { shader \"a.comp\" group 8 8 1  write s as storage  dispatch over view.x - 2 }")),
            "RG0373 a dispatch over -1 does nothing\n");
}

TEST(Amounts, AnIndexedDrawStaysWithinItsIndices) {
  const std::string indices = "buffer i : u32[view.x]\npass f : transfer { fill i 0 }\n", read = "read i as index  ";
  EXPECT_EQ(of_draw(read + "draw indexed view.x", indices), "");
  EXPECT_EQ(of_draw(read + "draw indexed view.x - 1 first 1", "buffer i : u32[view.x + 4]\npass f : transfer { fill i 0 }\n"), "");
  EXPECT_EQ(of_draw(read + "draw indexed view.x first 1", indices),
            "RG0495 pass `p` draws up to index 64 of `i`, which holds 64; make it longer or draw fewer\n");
  EXPECT_EQ(of_draw("read i.bytes(0, 12) as index  draw indexed 4", "buffer i : u32[view.x + 4]\npass f : transfer { fill i 0 }\n"),
            "RG0495 pass `p` draws up to index 3 of `i`, which holds 3; make it longer or draw fewer\n");
}

TEST(Amounts, IndirectArgumentsStayWithinTheirBuffer) {
  const auto buffer = [](const std::string& length) { return "buffer b : u32[" + length + "]\npass f : transfer { fill b 0 }\n"; };
  const auto dispatch = [&](const std::string& length) {
    return errors_of(
        loaded_graph(buffer(length) + "pass p : compute { shader \"a.comp\" group 8 8 1  write s as storage clear 0  dispatch indirect b }"));
  };
  EXPECT_EQ(dispatch("3"), "");
  EXPECT_EQ(dispatch("2"), "RG0496 the indirect arguments of pass `p` take 12 bytes, and `b` holds 8; make it longer or draw fewer\n");
  EXPECT_EQ(of_draw("draw indirect b max 10", buffer("40")), "");
  EXPECT_EQ(of_draw("draw indirect b max 10", buffer("39")),
            "RG0496 the indirect arguments of pass `p` take 160 bytes, and `b` holds 156; make it longer or draw fewer\n");
  EXPECT_EQ(of_draw("draw indirect b.bytes(16, 8) max 1", buffer("40")),
            "RG0496 the indirect arguments of pass `p` take 16 bytes, and `b` holds 8; make it longer or draw fewer\n");
}

TEST(Amounts, SizesAreJudgedAtTheLeastExtents) {
  const golden::Loaded image = loaded_graph("image e : rgba8 view - 8 output\npass p : raster { color e clear 0  color s clear 0 }");
  EXPECT_EQ(errors_of(image).substr(0, 55), "RG0315 image `e` is -7 texels along an axis; the limits");
  ASSERT_FALSE(image.diagnostics.rows()[0].notes.empty());
  EXPECT_EQ(row(image.diagnostics.rows()[0].notes[0].kind).code, std::string("RG0498"));
  EXPECT_EQ(image.diagnostics.rows()[0].notes[0].message(), "that is where the extents are least; a larger `min(...)` behind them rules it out");
  EXPECT_EQ(errors_of(loaded_graph("buffer b : u32[(view.x - 8) * 4]\npass f : transfer { fill b 0 }")),
            "RG0316 buffer `b` has -28 elements; the limits are 1 and 4294967295\n");
  EXPECT_EQ(errors_of(loaded_graph("image e : rgba8 view / 2 output\npass p : raster { color e clear 0 }")), "") << "a half of 1 is 1";
}

TEST(Amounts, ACubeIsSquareAtAllExtents) {
  const auto cube = [](const std::string& size) {
    return errors_of(loaded_graph("image c : rgba8 " + size + " cube output\npass p : transfer { clear c 0 }"));
  };
  const std::string refused =
      "RG0497 the faces of cube `c` are not square at all extents; one length for both axes makes them so, as in `[view.x, view.x]`\n";
  EXPECT_EQ(cube("64x32"), refused);
  EXPECT_EQ(cube("view"), refused) << "only the initial extents are square";
  EXPECT_EQ(cube("64x64"), "");
  EXPECT_EQ(cube("[view.x / 2, view.x / 2]"), "");
}

TEST(Amounts, APassBindsOneSet) {
  const std::string sets = "set a 0 { uniform sampler2D x[4]; }\nset b 2 { uniform sampler2D y[4]; }\n";
  const auto pass = [&](const std::string& binds) { return errors_of(loaded_graph("pass p : raster { " + binds + "  color s clear 0 }", sets)); };
  EXPECT_EQ(pass("bind a"), "");
  EXPECT_EQ(pass("bind a  bind a"), "");
  EXPECT_EQ(pass("bind a  bind b"), "RG0493 pass `p` binds set `a` already; it takes one set of the engine: declare what `b` holds in `a`, too\n");
}

// Depth and stencil in one image are resolved each for itself, and stencil is not.
TEST(Amounts, ARenderingResolvesNoStencil) {
  const auto resolve = [](const std::string& format, const std::string& drawn, const std::string& what) {
    return errors_of(loaded_graph("image d : " + format + " view samples 4\nimage r : " + format + " view output\npass y : raster { " + drawn +
                                  "  draw host  resolve " + what + " }"));
  };
  const std::string refused = "RG0492 a rendering resolves colour or depth, not stencil, and `d` is `d32f_s8`; ";
  EXPECT_EQ(resolve("d32f", "depth d clear 1", "d -> r"), "");
  EXPECT_EQ(resolve("d32f_s8", "depth d clear 1  stencil d clear 0", "d.depth -> r.depth"), "");
  EXPECT_EQ(resolve("d32f_s8", "depth d clear 1", "d -> r"), refused + "say `resolve d.depth -> r.depth`\n");
  EXPECT_EQ(resolve("d32f_s8", "depth d clear 1", "d.depth -> r"), refused + "say `resolve d.depth -> r.depth`\n");
  EXPECT_EQ(resolve("d32f_s8", "stencil d clear 0", "d.stencil -> r.stencil"), refused + "read the samples of its stencil in a shader\n");
  EXPECT_EQ(resolve("d32f_s8", "stencil d clear 0", "d -> r"), refused + "read the samples of its stencil in a shader\n");
  EXPECT_EQ(
      errors_of(
          loaded_graph("image d : d32f_s8 view samples 4\nimage r : d32f_s8 view output\npass y : raster { depth d clear 1  stencil d clear 0 }\n"
                       "pass t : transfer { resolve d -> r }")),
      "RG0483 a transfer pass resolves colour alone, and `d` is `d32f_s8`; say `resolve d.depth -> r.depth` in the raster pass that draws `d`\n");
}

// With which choice of features, or on which condition, a read has no writer.
TEST(Amounts, AMissingPassIsMissingWithSomething) {
  const auto why = [](const std::string& writers, const std::string& reader) {
    const golden::Loaded loaded =
        loaded_graph("image x : rgba8 view\n" + writers + "\n" + reader, "feature f: bool\nfeature path: { low, mid, high }\ncondition late[2]\n");
    const auto& rows = loaded.diagnostics.rows();
    return rows.empty() || rows[0].notes.empty() ? std::string("nothing") : rows[0].notes[0].message();
  };
  const std::string read = "pass r : raster { read x as sampled in fragment  color s clear 0 }", pass = " : compute { write x as storage } }";
  EXPECT_EQ(why("when f { pass w" + pass, read), "pass `w` may leave it as it was: it is missing with `f=off`");
  EXPECT_EQ(why("when not f { pass w" + pass, read), "pass `w` may leave it as it was: it is missing with `f=on`");
  EXPECT_EQ(why("when path == low { pass w" + pass + " else when path == high { pass v" + pass, read),
            "pass `v` may leave it as it was: it is missing with `path=mid`");
  EXPECT_EQ(why("when f { when path == low { pass w" + pass + " }", "when f { " + read + " }"),
            "pass `w` may leave it as it was: it is missing with `f=on` and `path=mid`");
  EXPECT_EQ(why("if host late[1] { pass w" + pass, read), "pass `w` may leave it as it was: the host decides by `late[1]` whether it runs");
  EXPECT_EQ(why("if host late[0] { when f { pass w" + pass + " }", "if host late[0] { " + read + " }"),
            "pass `w` may leave it as it was: it is missing with `f=off`");
}

TEST(Amounts, WordsKeptForTheFutureOfGlsl) {
  const auto image = [](const std::string& name) {
    return errors_of(loaded_graph("image " + name + " : rgba8 view\npass w : compute { write " + name +
                                  " as storage }\npass r : raster { fullscreen \"r.frag\"  read " + name + " as sampled  color s }"));
  };
  for (const char* name : {"half", "input", "output", "filter", "resource", "common", "active", "texture2D", "usamplerCubeArray"})
    EXPECT_EQ(image(name), std::string("RG0213 `") + name + "` is reserved in GLSL; rename it for the shaders: `read other = ...`\n");
  for (const char* name : {"halves", "texture", "image", "inputs", "source", "textureShadow", "packed"}) EXPECT_EQ(image(name), "") << name;
  EXPECT_EQ(errors_of(load_one("const half = 3\n")), "RG0213 `half` is reserved in GLSL; call the constant otherwise\n");
}

}  // namespace
}  // namespace rg::dsl
