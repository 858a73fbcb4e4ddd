#include "dsl/front_end.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "dsl/format.h"
#include "dsl/format_table.h"
#include "dsl/lexer.h"
#include "dsl/paths.h"
#include "dsl/print.h"
#include "golden.h"

namespace rg::dsl {
namespace {

golden::Loaded load_text(const std::string& text) { return golden::load("test.rg", {{"test.rg", text}}); }

std::string in_graph(const std::string& items) {
  return "extent view = runtime(100, 50) max(200, 99)\ngraph g(surface s: rgba8 4x4) {\n" + items + "\n}\n";
}

std::string messages(const golden::Loaded& loaded) { return print(loaded.diagnostics, loaded.result.files, false); }

TEST(FrontEnd, MissingRoot) {
  const golden::Loaded loaded = golden::load("no/such/file.rg");
  ASSERT_EQ(loaded.diagnostics.rows().size(), 1u);
  EXPECT_EQ(loaded.diagnostics.rows()[0].message(), "cannot read `no/such/file.rg`: no such file");
  EXPECT_EQ(messages(loaded), "error[RG0001]: cannot read `no/such/file.rg`: no such file\n");
}

TEST(FrontEnd, BinaryFile) {
  const golden::Loaded loaded = load_text(std::string("module a\0b", 10));
  ASSERT_EQ(loaded.diagnostics.rows().size(), 1u);
  EXPECT_EQ(loaded.diagnostics.rows()[0].message(), "cannot read `test.rg`: it is not text");
}

TEST(FrontEnd, ImportsTooDeep) {
  std::map<std::string, std::string> files;
  for (int i = 0; i < 250; ++i) files["f" + std::to_string(i) + ".rg"] = "import \"f" + std::to_string(i + 1) + ".rg\"\n";
  const golden::Loaded loaded = golden::load("f0.rg", files);
  ASSERT_EQ(loaded.diagnostics.rows().size(), 1u);
  EXPECT_EQ(row(loaded.diagnostics.rows()[0].kind).code, "RG0006");
  EXPECT_EQ(loaded.result.files.size(), 201u);
}

TEST(FrontEnd, EmptyFileIsAnEmptyProgram) {
  const golden::Loaded loaded = load_text("");
  EXPECT_TRUE(loaded.diagnostics.rows().empty());
  EXPECT_EQ(loaded.result.program.module, "test");
  EXPECT_EQ(loaded.result.program.graphs.size(), 0u);
}

TEST(FrontEnd, LineEndingsAndByteOrderMarkDoNotMatter) {
  const std::string text = in_graph("pass p : compute { write s as storage }");
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const golden::Loaded plain = load_text(text), other = load_text(windows);
  EXPECT_EQ(messages(other), "");
  EXPECT_EQ(print_program(plain.result.program), print_program(other.result.program));
}

TEST(FrontEnd, DiamondImportsAreReadOnce) {
  const golden::Loaded loaded = golden::load("a.rg", {{"a.rg", "import \"b.rg\"\nimport \"c.rg\"\nconst A = D + d.D\n"},
                                                      {"b.rg", "import \"d.rg\"\n"},
                                                      {"c.rg", "import \"d.rg\"\n"},
                                                      {"d.rg", "const D = 4\n"}});
  EXPECT_EQ(messages(loaded), "");
  EXPECT_EQ(loaded.result.files.size(), 4u);
  ASSERT_EQ(loaded.result.program.constants.size(), 2u);
  EXPECT_EQ(loaded.result.program.constants[0].name, "D");  // imports first
  EXPECT_EQ(loaded.result.program.constants[1].value, 8);
}

TEST(FrontEnd, ShaderPathsAreOfTheModuleThatNamesThem) {
  const std::string technique =
      "technique t(inout image target) {\n pass p : compute { shader \"./x/../go.comp\" group 8 8 1  write target as storage  dispatch over target "
      "}\n}\n";
  const golden::Loaded loaded =
      golden::load("root/a.rg", {{"root/a.rg", "import \"sub/b.rg\"\n" + in_graph("use t(s)")}, {"root/sub/b.rg", technique}});
  EXPECT_EQ(messages(loaded), "");
  EXPECT_EQ(loaded.result.program.graphs[GraphId{size_t{0}}].passes.rows[0].shaders[0].path, "sub/go.comp");
}

TEST(Paths, StayInside) {
  EXPECT_EQ(join_inside("a/b/", "c.rg"), "a/b/c.rg");
  EXPECT_EQ(join_inside("a/b/", "../c.rg"), "a/c.rg");
  EXPECT_EQ(join_inside("a/", "../../c.rg"), std::nullopt);
  EXPECT_EQ(join_inside("", "/etc/passwd"), std::nullopt);
  EXPECT_EQ(join_inside("", "a\\b"), std::nullopt);
  EXPECT_EQ(join_inside("", ""), std::nullopt);
  EXPECT_EQ(folder_of("a/b/c.rg"), "a/b/");
}

// ---- values -----------------------------------------------------------------------------------------------------

int64_t count_of(const std::string& expression, const std::vector<int64_t>& extents) {
  const golden::Loaded loaded =
      load_text(in_graph("buffer b : u32[" + expression + "] output\npass p : compute { write b as storage  write s as storage }"));
  EXPECT_EQ(messages(loaded), "") << expression;
  if (loaded.diagnostics.has_errors()) return -1;
  const Program& program = loaded.result.program;
  return evaluate(program, program.graphs[GraphId{size_t{0}}].resources.rows[1].count, extents);
}

TEST(Values, EvaluateAtTheExtentsGiven) {
  const std::vector<int64_t> at = {100, 50, 1};
  EXPECT_EQ(count_of("view.x + view.y * 2 - 1", at), 199);
  EXPECT_EQ(count_of("view.x / 3", at), 33);
  EXPECT_EQ(count_of("ceil(view.x / 3)", at), 34);
  EXPECT_EQ(count_of("ceil(view / 8).area", at), 13 * 7);
  EXPECT_EQ(count_of("min(view.x, 7, view.y) + max(view.x, view.y)", at), 107);
  EXPECT_EQ(count_of("(view / 2 + 1).area", at), 51 * 26);
  EXPECT_EQ(count_of("s.width * s.height", at), 16);
  EXPECT_EQ(count_of("(7 - 10) / 2 + 10", at), 8);  // rounds down
}

TEST(Values, SharedSubexpressionsAreEvaluatedOnce) {
  std::string text = "extent view = runtime(1)\nconst A0 = view + 1\n";
  for (int i = 1; i < 40; ++i)
    text += "const A" + std::to_string(i) + " = min(A" + std::to_string(i - 1) + " + A" + std::to_string(i - 1) + ", 1000)\n";
  const golden::Loaded loaded =
      load_text(text + "graph g(surface s: rgba8 4x4) { buffer b : u32[A39] output  pass p : compute { write b as storage  write s as storage } }");
  EXPECT_EQ(messages(loaded), "");
  EXPECT_EQ(evaluate(loaded.result.program, loaded.result.program.graphs[GraphId{size_t{0}}].resources.rows[1].count, {1, 1, 1}), 1000);
}

TEST(Values, ExtentsInTheFormEvaluateTakes) {
  const Program program = load_text(in_graph("")).result.program;
  EXPECT_EQ(initial_extents(program), (std::vector<int64_t>{100, 50, 1}));
  EXPECT_EQ(maximum_extents(program), (std::vector<int64_t>{200, 99, 1}));
}

// ---- loops, modes -----------------------------------------------------------------------------------------------

const Pass& find_pass(const Program& program, const std::string& name) {
  for (const Pass& pass : program.graphs[GraphId{size_t{0}}].passes)
    if (pass.name == name) return pass;
  static const Pass none;
  ADD_FAILURE() << "no pass " << name;
  return none;
}

TEST(Loops, UnrollOverDeclaredMips) {
  const golden::Loaded loaded = load_text(in_graph(R"(
    image m : r32f 64x64 mips 7
    pass first : compute { write m.mip(0) as storage }
    for i in 1..mips(m) { pass down[i] : compute { read from = m.mip(i - 1) as sampled  write to = m.mip(i) as storage } }
    pass last : compute { read m as sampled  write s as storage })"));
  EXPECT_EQ(messages(loaded), "");
  EXPECT_EQ(loaded.result.program.graphs[GraphId{size_t{0}}].passes.size(), 8u);
  const Pass& down = find_pass(loaded.result.program, "down[6]");
  ASSERT_EQ(down.accesses.size(), 2u);
  EXPECT_EQ(down.accesses[0].range.mip, 5u);
  EXPECT_EQ(down.accesses[1].range.mip, 6u);
  EXPECT_EQ(down.mip_limits.size(), 2u);
}

Mode mode_of(const std::string& pass, size_t access) {
  const golden::Loaded loaded =
      load_text(in_graph("image a : rgba8 4x4\nbuffer args : u32[4]\npass zero : transfer { clear a 0  clear s 0  fill args 1 }\n" + pass));
  EXPECT_EQ(messages(loaded), "") << pass;
  const auto& passes = loaded.result.program.graphs[GraphId{size_t{0}}].passes;
  return passes.rows.back().accesses.at(access).mode;
}

TEST(Modes, WhatDefinesAndWhatKeeps) {
  EXPECT_EQ(mode_of("pass p : raster { color s }", 0), Mode::update);
  EXPECT_EQ(mode_of("pass p : raster { color s clear 0 }", 0), Mode::write);
  EXPECT_EQ(mode_of("pass p : raster { color s covers }", 0), Mode::write);
  EXPECT_EQ(mode_of("pass p : raster { color s covers blend add(one, one) }", 0), Mode::update);
  EXPECT_EQ(mode_of("pass p : raster { fullscreen \"a.frag\"  color s }", 0), Mode::write);
  EXPECT_EQ(mode_of("pass p : raster { fullscreen \"a.frag\"  color s blend add(one, one) }", 0), Mode::update);
  EXPECT_EQ(mode_of("pass p : compute { write s as storage }", 0), Mode::write);
  EXPECT_EQ(mode_of("pass p : compute { shader \"a.comp\" group 8 8 1  write s as storage  dispatch indirect args }", 0), Mode::update);
  EXPECT_EQ(mode_of("pass p : compute { shader \"a.comp\" group 8 8 1  write s as storage covers  dispatch indirect args }", 0), Mode::write);
  EXPECT_EQ(mode_of("pass p : raster { color s  write a as storage }", 1), Mode::update);
  EXPECT_EQ(mode_of("pass p : compute { read s as storage  write s as storage }", 0), Mode::update);
}

TEST(Clears, BecomeOneTransferPassBefore) {
  const golden::Loaded loaded = load_text(in_graph(R"(
    buffer a : u32[4]
    image b : r32ui 4x4
    buffer c : f32[4]
    pass p : compute { atomic a as storage clear 7  atomic b as storage clear 9  update c as storage clear 1.5  write s as storage })"));
  EXPECT_EQ(messages(loaded), "");
  const auto& passes = loaded.result.program.graphs[GraphId{size_t{0}}].passes;
  ASSERT_EQ(passes.size(), 2u);
  const Pass& clear = passes.rows[0];
  EXPECT_EQ(clear.name, "p.clear");
  EXPECT_EQ(clear.kind, PassKind::transfer);
  ASSERT_EQ(clear.transfers.size(), 3u);
  EXPECT_EQ(clear.transfers[0].kind, TransferKind::fill);
  EXPECT_EQ(clear.transfers[0].value.u[0], 7u);
  EXPECT_EQ(clear.transfers[1].kind, TransferKind::clear);
  EXPECT_EQ(clear.transfers[1].value.u[0], 9u);
  EXPECT_EQ(clear.transfers[2].value.u[0], 0x3fc00000u);  // the bits of 1.5f
  EXPECT_EQ(clear.accesses[1].role, Role::clear_dst);
  for (const Access& access : passes.rows[1].accesses) EXPECT_FALSE(access.clear.has_value());
}

// ---- the rest ---------------------------------------------------------------------------------------------------

TEST(Formats, AgreeWithTheTable) {
  EXPECT_STREQ(name(Format::rgba16f), "rgba16f");
  EXPECT_EQ(find_format("d32f_s8"), Format::d32f_s8);
  EXPECT_EQ(find_format("nothing"), Format::none);
  EXPECT_EQ(info(Format::bc7).block_bytes, 16u);
  EXPECT_EQ(info(Format::d24_s8).aspects, uint32_t{aspect_depth | aspect_stencil});
  for (const std::string_view each : format_names()) EXPECT_EQ(name(find_format(each)), each);
}

TEST(Json, HasTheDocumentedShape) {
  const golden::Loaded loaded = load_text("const A = 1\nconst A = BB\nconst BBB = 2\n");
  const auto json = nlohmann::json::parse(print_json(loaded.diagnostics, loaded.result.files));
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["code"], "RG0201");
  EXPECT_EQ(json[0]["name"], "DuplicateName");
  EXPECT_EQ(json[0]["severity"], "error");
  EXPECT_EQ(json[0]["message"], "`A` is declared twice");
  EXPECT_EQ(json[0]["file"], "test.rg");
  EXPECT_EQ(json[0]["line"], 2);
  EXPECT_EQ(json[0]["column"], 7);
  EXPECT_EQ(json[0]["end_column"], 8);
  EXPECT_EQ(json[0]["notes"][0]["line"], 1);
  EXPECT_TRUE(json[0]["fixes"].empty());
}

TEST(Text, ShowsPlaceCaretNotesAndFix) {
  const golden::Loaded loaded = load_text("const LONG = 1\nconst A = LOGN + 1\n");
  EXPECT_EQ(messages(loaded),
            "test.rg:2:11: error[RG0203]: there is no constant, extent or resource called `LOGN`\n"
            "     2 | const A = LOGN + 1\n"
            "       |           ^~~~\n"
            "       = fix: write `LONG` instead of `LOGN`\n");
  EXPECT_NE(print(loaded.diagnostics, loaded.result.files, true).find("\033[1;31m"), std::string::npos);
}

TEST(Diagnostics, SortByPlaceAndDropRepeats) {
  Diagnostics all;
  const FileId file{size_t{0}};
  all.report(DiagnosticKind::Overflow, {file, 9, 10});
  all.report(DiagnosticKind::DivisionByZero, {file, 3, 4});
  all.report(DiagnosticKind::Overflow, {file, 9, 10});
  all.sort();
  ASSERT_EQ(all.rows().size(), 2u);
  EXPECT_EQ(all.rows()[0].kind, DiagnosticKind::DivisionByZero);
  EXPECT_TRUE(all.has_errors());
}

TEST(Fixes, LeadToAProgramWithoutTheMistake) {
  std::string text = "extent view = runtime(4, 4)\ngraph g(surface s: rgba8 veiw) { pass p : compute { wriet s as storage } }\n";
  for (int round = 0; round < 3; ++round) {
    const golden::Loaded loaded = load_text(text);
    if (!loaded.diagnostics.has_errors()) break;
    ASSERT_FALSE(loaded.diagnostics.rows()[0].fixes.empty()) << messages(loaded);
    const FixIt fix = loaded.diagnostics.rows()[0].fixes[0];
    text.replace(fix.span.begin, fix.span.end - fix.span.begin, fix.text);
  }
  EXPECT_FALSE(load_text(text).diagnostics.has_errors()) << text;
}

TEST(Format, IsIdempotentOnEveryFileOfTheTree) {
  size_t count = 0;
  for (const char* folder : {"/passes", "/tests", "/docs", "/examples"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(RGC_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".rg") continue;
      Diagnostics diagnostics;
      const auto once = format(FileId{size_t{0}}, golden::read_text(entry.path().string()), diagnostics);
      if (!once) continue;
      ++count;
      EXPECT_EQ(format(FileId{size_t{0}}, *once, diagnostics), once) << entry.path();
    }
  EXPECT_GT(count, 20u);
}

TEST(Frame, PassesWithoutAnyMessage) {
  const golden::Loaded loaded = golden::load(std::string(RGC_SOURCE_DIR) + "/passes.rg");
  EXPECT_EQ(messages(loaded), "");
  ASSERT_EQ(loaded.result.program.graphs.size(), 1u);
  EXPECT_GE(loaded.result.program.graphs.rows[0].passes.size(), 16u);
}

std::string long_graph(size_t passes) {
  std::string items;
  for (size_t i = 0; i < passes; ++i) {
    const std::string n = std::to_string(i);
    items += "image a" + n + " : rgba8 64x64\npass p" + n + " : compute {\n";
    if (i > 0) items += "read a" + std::to_string(i - 1) + " as sampled\n";
    items += "write a" + n + " as storage\n}\n";
  }
  return in_graph(items + "pass last : compute { read a" + std::to_string(passes - 1) + " as sampled  write s as storage }");
}

// Steps, not seconds: the tables grow with the text, and the test ends at all.
TEST(Scale, TenThousandPasses) {
  const golden::Loaded loaded = load_text(long_graph(10000));
  EXPECT_EQ(messages(loaded), "");
  EXPECT_EQ(loaded.result.program.graphs.rows[0].passes.size(), 10001u);
  EXPECT_LT(loaded.result.program.exprs.size(), 10u);
}

}  // namespace
}  // namespace rg::dsl
