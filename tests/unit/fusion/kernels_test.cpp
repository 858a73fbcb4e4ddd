// Fused kernels against the same blocks one by one, on a real driver, bit for bit.
#include <cmath>
#include <cstring>
#include <random>

#include "tests/unit/fusion/fixture.h"

namespace rg::test {
namespace {

// Both forms are proved and run; what they leave in `shown` is handed out.
struct Both {
  std::optional<std::vector<uint32_t>> fused, apart;
  size_t kernels = 0;
};
Both run_both(const Files& files) {
  Both both;
  for (const bool fuse : {true, false}) {
    const Compiled compiled = compile_files(files, fuse);
    EXPECT_FALSE(compiled.diagnostics.has_errors()) << compiled.text();
    if (compiled.diagnostics.has_errors()) return {};
    prove(compiled.result);
    run_machine(compiled.result);
    (fuse ? both.fused : both.apart) = run(compiled.result, "shown");
    if (fuse) both.kernels = compiled.result.fused.size();
  }
  return both;
}

float as_float(uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool same_bits(uint32_t a, uint32_t b) { return a == b || (std::isnan(as_float(a)) && std::isnan(as_float(b))); }

void expect_equal(const Both& both, const std::string& what) {
  if (!both.fused || !both.apart) return;
  ASSERT_EQ(both.fused->size(), both.apart->size()) << what;
  size_t wrong = 0;
  for (size_t i = 0; i < both.fused->size(); ++i) {
    if (same_bits((*both.fused)[i], (*both.apart)[i])) continue;
    if (++wrong <= 3)
      ADD_FAILURE() << what << " word " << i << ": fused " << std::hex << (*both.fused)[i] << " = " << as_float((*both.fused)[i]) << ", apart "
                    << (*both.apart)[i] << " = " << as_float((*both.apart)[i]);
  }
  EXPECT_EQ(wrong, 0u) << what;
}

// ---- formats

struct FormatCase {
  const char* name;
  char kind;
  uint32_t components;
};
constexpr FormatCase kFormats[] = {
    {"r8", 'f', 1},         {"rg8", 'f', 2},     {"rgba8", 'f', 4},     {"r8_snorm", 'f', 1},  {"rg8_snorm", 'f', 2},  {"rgba8_snorm", 'f', 4},
    {"r16", 'f', 1},        {"rg16", 'f', 2},    {"rgba16", 'f', 4},    {"r16_snorm", 'f', 1}, {"rg16_snorm", 'f', 2}, {"rgba16_snorm", 'f', 4},
    {"r16f", 'f', 1},       {"rg16f", 'f', 2},   {"rgba16f", 'f', 4},   {"r32f", 'f', 1},      {"rg32f", 'f', 2},      {"rgba32f", 'f', 4},
    {"r11g11b10f", 'f', 3}, {"rgb10a2", 'f', 4}, {"rgb10a2ui", 'u', 4}, {"r8ui", 'u', 1},      {"rg8ui", 'u', 2},      {"rgba8ui", 'u', 4},
    {"r16ui", 'u', 1},      {"rg16ui", 'u', 2},  {"rgba16ui", 'u', 4},  {"r32ui", 'u', 1},     {"rgba32ui", 'u', 4},   {"r8i", 'i', 1},
    {"rg8i", 'i', 2},       {"rgba8i", 'i', 4},  {"r16i", 'i', 1},      {"rg16i", 'i', 2},     {"rgba16i", 'i', 4},    {"r32i", 'i', 1},
};

// Every pattern of the upper 16 bits; `near` keeps floats where a normalised format has steps.
Files format_files(const FormatCase& format, bool near) {
  const std::string scalar = format.kind == 'f' ? "float" : format.kind == 'u' ? "uint" : "int";
  const std::string count = std::to_string(format.components), prefix = format.kind == 'f' ? "" : std::string(1, format.kind);
  const std::string type = format.components == 1 ? scalar : prefix + "vec" + count;
  std::string value, bits;
  for (uint32_t i = 0; i < format.components; ++i) {
    value += (i == 0 ? "" : ", ") + std::string("one(at, ") + std::to_string(i) + "u)";
    const std::string part = format.components == 1 ? "value" : std::string("value.") + "xyzw"[i];
    bits += std::string(i == 0 ? "" : ", ") + (format.kind == 'f' ? "floatBitsToUint(" + part + ")" : "uint(" + part + ")");
  }
  for (uint32_t i = format.components; i < 4; ++i) bits += ", 0u";
  const std::string body = format.kind != 'f' ? "return " + scalar + "(bits);"
                           : near             ? "return (float(bits >> 8) / 16777216.0 * 2.5 - 1.25);"
                                              : "return uintBitsToFloat(bits);";
  return {{"main.rg", std::string("module main\nstruct Four { v: uvec4 }\ngraph g() {\n  image value : ") + format.name + R"( 256x256
  buffer shown : Four[65536] readback
  fuse both {
    pass make : compute { block "make.glsl"  write value as element  dispatch over 256x256 }
    pass show : compute { block "show.glsl"  read value as element  write shown as element  dispatch over 256x256 }
  }
}
)"},
          {"make.glsl", scalar + R"( one(ivec2 at, uint part) {
  uint bits = uint(at.y * 256 + at.x) << 16;
  bits ^= part * 0x9E3779B9u;
  uint low = bits * 2654435761u;
  bits |= (low >> 13) & 0xFFFFu;
  )" + body +
                            "\n}\nvoid element(ivec2 at) { value = " + (format.components == 1 ? value : type + "(" + value + ")") + "; }\n"},
          {"show.glsl", "void element(ivec2 at) { shown.v = uvec4(" + bits + "); }\n"}};
}

TEST(Conversions, AreThoseOfAStoreAndALoad) {
  for (const FormatCase& format : kFormats)
    for (const bool near : {false, true}) {
      if (near && format.kind != 'f') continue;
      const Both both = run_both(format_files(format, near));
      EXPECT_EQ(both.kernels, 1u);
      expect_equal(both, std::string(format.name) + (near ? " near" : " far"));
    }
}

float nearest_half(float value) {
  if (std::abs(value) < 6.103515625e-05f) return std::nearbyint(value * 16777216.0f) / 16777216.0f;
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return as_float((bits + 0xFFFu + (bits >> 13 & 1u)) >> 13 << 13);
}

// What GPUs do.
TEST(Conversions, OfHalvesMayRoundToTheNearest) {
  Files exact = format_files({"r32f", 'f', 1}, true);
  compiler::CompileOptions options;
  options.halves = compiler::HalfRounding::nearest;
  const Compiled rounded = compile_files(format_files({"r16f", 'f', 1}, true), true, {}, options), reference = compile_files(exact, false);
  ASSERT_FALSE(rounded.diagnostics.has_errors()) << rounded.text();
  ASSERT_FALSE(reference.diagnostics.has_errors()) << reference.text();
  const auto halves = run(rounded.result, "shown"), values = run(reference.result, "shown");
  if (!halves || !values) return;
  for (size_t i = 0; i < values->size(); i += 4) ASSERT_EQ(as_float((*halves)[i]), nearest_half(as_float((*values)[i]))) << i;
}

TEST(Conversions, AreLeftOutWhereTheProgramSaysSo) {
  Files files = format_files({"r8", 'f', 1}, true);
  std::string& text = files["main.rg"];
  text.replace(text.find("fuse both"), 9, "fuse both unrounded");
  const Both rounded = run_both(format_files({"r8", 'f', 1}, true)), full = run_both(files);
  if (!full.fused || !rounded.fused) return;
  EXPECT_EQ(*full.apart, *rounded.apart);
  size_t different = 0;
  for (size_t i = 0; i < full.fused->size(); ++i) different += (*full.fused)[i] != (*rounded.fused)[i];
  EXPECT_GT(different, 30000u);
}

// ---- chains

// Blocks one after the other on a chain of images, each reading some of what came before; every name is used by all of them.
Files random_chain(uint32_t seed, const char* const* formats, size_t format_count) {
  std::mt19937 random(seed);
  const auto pick = [&](size_t below) { return static_cast<size_t>(random() % below); };
  const size_t blocks = 2 + pick(5);
  std::string resources, passes;
  Files files;
  for (size_t b = 0; b < blocks; ++b) {
    const std::string number = std::to_string(b), image = "v" + number;
    const char* format = formats[pick(format_count)];
    resources += "  image " + image + " : " + format + " size" + (b + 1 == blocks ? " output" : "") + "\n";
    std::string reads, sum = "vec4(float(at.x) * 0.013, float(at.y) * 0.017, 0.3, 0.7)";
    for (size_t from = b < 2 ? 0 : b - 2; from < b; ++from) {
      if (from + 1 != b && pick(2) == 0) continue;
      reads += "      read   i" + std::to_string(from) + " = v" + std::to_string(from) + " as element\n";
      sum += " + weight(i" + std::to_string(from) + ", " + std::to_string(0.1 + 0.2 * static_cast<double>(pick(4))) + ")";
    }
    const bool last = b + 1 == blocks;
    passes += "    pass p" + number + " : compute {\n      block  \"b" + number + ".glsl\"\n" + reads + "      write  o = " + image +
              " as element\n" + (last ? "      write  shown as element\n" : "") + "      dispatch over size\n    }\n";
    files["b" + number + ".glsl"] = "const float SCALE = " + std::to_string(1 + pick(3)) +
                                    ".0;\nstruct Pair { vec4 value; float i; };\n"
                                    "vec4 weight(vec4 value, float by) {\n  precise Pair p = Pair(value * by, SCALE);\n  precise vec4 r = p.value * "
                                    "p.i + 0.125;\n  return r;\n}\n"
                                    "void element(ivec2 at) {\n  precise vec4 sum = " +
                                    sum + ";\n  o = fract(sum * 0.37 + SCALE);\n" + (last ? "  shown.v = floatBitsToUint(o);\n" : "") + "}\n";
  }
  files["main.rg"] = "module main\nextent size = runtime(61, 37) max(64, 64)\nstruct Four { v: uvec4 }\ngraph g() {\n" + resources +
                     "  buffer shown : Four[size.area] readback\n  fuse chain {\n" + passes + "  }\n}\n";
  return files;
}

TEST(Chains, OfFullPrecisionAreTheSameBits) {
  const char* const formats[] = {"rgba32f"};
  for (uint32_t seed = 1; seed <= 12; ++seed) {
    const Both both = run_both(random_chain(seed, formats, 1));
    EXPECT_EQ(both.kernels, 1u);
    expect_equal(both, "seed " + std::to_string(seed));
  }
}

TEST(Chains, OfSmallFormatsAreTheSameBits) {
  const char* const formats[] = {"rgba16f", "rgba8", "rgba16", "rgb10a2", "rgba8_snorm"};
  for (uint32_t seed = 101; seed <= 116; ++seed) {
    const Both both = run_both(random_chain(seed, formats, std::size(formats)));
    EXPECT_EQ(both.kernels, 1u);
    expect_equal(both, "seed " + std::to_string(seed));
  }
}

// ---- lines

// A source, a scan of it and a block that reads the sums. `lines`: what stands behind the path of the scanning block.
Files scan_files(const std::string& lines, const std::string& extent, bool associative) {
  const std::string sums = associative ? R"(
Sum own(ivec3 at) { return Sum(source.xy, 1.0 / (1.0 + abs(source.x))); }
Sum join(Sum near, Sum far) { return Sum(near.light + near.through * far.light, near.through * far.through); }
void element(ivec3 at, Sum sum) { total = vec4(sum.light, sum.through, 0.0); }
)"
                                       : R"(
void element(ivec3 at, inout Sum sum) {
  sum = Sum(sum.light + sum.through * source.xy, sum.through / (1.0 + abs(source.x)));
  total = vec4(sum.light, sum.through, 0.0);
}
)";
  return {{"main.rg", "module main\nextent size = runtime(" + extent + R"() max(64, 64, 64)
struct Four { v: uvec4 }
struct Sum { light: vec2  through: f32 }
graph g() {
  image source : rgba32f size
  image total  : rgba32f size
  image kept   : rgba32f size output
  buffer shown : Four[size.area] readback
  fuse lines {
    pass make : compute { block "make.glsl"  write source as element  dispatch over size }
    pass sum : compute { block "sum.glsl" )" +
                          lines + R"(  read source as element  write total as element  dispatch over size }
    pass use_it : compute {
      block "use.glsl"
      read source as element  read total as element  write kept as element  write shown as element
      dispatch over size
    }
  }
}
)"},
          {"make.glsl",
           "void element(ivec3 at) {\n  uint h = uint(at.x * 31 + at.y * 57 + at.z * 101) * 2654435761u;\n"
           "  source = vec4(float(h >> 20) / 4096.0, float(h & 1023u) / 512.0, 0.25, 1.0);\n}\n"},
          {"sum.glsl", "Sum start(ivec3 at) { return Sum(vec2(float(at.x) * 0.01, 0.5), 1.0); }" + sums},
          {"use.glsl", "void element(ivec3 at) {\n  kept = total + source.x;\n  shown.v = floatBitsToUint(kept);\n}\n"}};
}

TEST(Scans, AreWalkedInOrder) {
  for (const char* extent : {"13, 9, 21", "5, 5, 4", "1, 1, 33"}) {
    const Both both = run_both(scan_files("scan z Sum", extent, false));
    EXPECT_EQ(both.kernels, 1u);
    expect_equal(both, extent);
  }
}

TEST(Scans, AlongEveryAxis) {
  for (const char* axis : {"x", "y", "z"}) expect_equal(run_both(scan_files(std::string("scan ") + axis + " Sum", "13, 9, 21", false)), axis);
}

// Four lanes are joined one after the other, in the order of a walk.
TEST(Scans, OfFewLanesAreInOrder) {
  const Both both = run_both(scan_files("group 4 4 4 scan z Sum associative", "13, 9, 21", true));
  const Both walked = run_both(scan_files("group 8 8 1 scan z Sum associative", "13, 9, 21", true));
  expect_equal(both, "four lanes");
  expect_equal({both.fused, walked.apart, 0}, "four lanes beside a walk");
}

TEST(Scans, OfManyLanesAreTheSameSums) {
  for (const char* lines : {"group 1 1 64 scan z Sum associative", "group 2 2 16 scan z Sum associative"})
    for (const char* extent : {"13, 9, 21", "3, 2, 64", "2, 2, 61"}) {
      const Both lanes = run_both(scan_files(lines, extent, true)), walked = run_both(scan_files("group 8 8 1 scan z Sum associative", extent, true));
      if (!lanes.fused || !walked.apart) return;
      ASSERT_EQ(lanes.fused->size(), walked.apart->size());
      for (size_t i = 0; i < lanes.fused->size(); ++i) {
        const float a = as_float((*lanes.apart)[i]), b = as_float((*walked.apart)[i]);
        ASSERT_NEAR(a, b, 1e-5f * std::abs(b) + 1e-6f) << lines << " over " << extent << " word " << i;
      }
    }
}

// ---- what the frame asks of them

TEST(Fusion, IsChosenByAFeature) {
  Files files = format_files({"r16f", 'f', 1}, true);
  std::string& text = files["main.rg"];
  text.replace(text.find("fuse both"), 9, "fuse both when together");
  text.insert(text.find("struct"), "feature together : bool\n");
  const Compiled compiled = compile_files(files);
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.text();
  const compiler::CompiledGraph& graph = compiled.result.graphs.at(0);
  ASSERT_EQ(graph.plans.size(), 2u);
  EXPECT_EQ(graph.plans[0].plan.passes.size(), 2u);
  EXPECT_EQ(graph.plans[1].plan.passes.size(), 1u);
  prove(compiled.result);
  const auto off = run(compile_files(files, true, {"together=off"}).result, "shown"),
             on = run(compile_files(files, true, {"together=on"}).result, "shown");
  if (off && on) expect_equal({on, off, 0}, "by feature");
}

TEST(Fusion, LeavesNothingOfWhatStaysInside) {
  const char* const formats[] = {"rgba32f"};
  const Compiled compiled = compile_files(random_chain(3, formats, 1));
  ASSERT_FALSE(compiled.diagnostics.has_errors()) << compiled.text();
  const PlanData& plan = compiled.result.graphs.at(0).plans.at(0).plan;
  ASSERT_EQ(plan.passes.size(), 1u);
  EXPECT_EQ(plan.accesses.size(), 2u) << "the last image and the buffer";
  ASSERT_EQ(compiled.result.fused.size(), 1u);
  EXPECT_GT(compiled.result.fused[0].members.size(), 1u);
}

}  // namespace
}  // namespace rg::test
