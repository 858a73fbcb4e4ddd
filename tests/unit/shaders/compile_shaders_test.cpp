#include "tests/unit/shaders/fixture.h"

namespace rg::compiler {
namespace {

using dsl::Format;
using dsl::Mode;
using dsl::Role;

constexpr dsl::Type kUint{dsl::Scalar::u32, 1, 1, {}, 0};

struct CompileShaders : testing::Test, Fixture {
  std::vector<dsl::Access> depth_to_hdr() {
    const auto depth = image("depth", Format::d32f), hdr = image("hdr", Format::rgba16f);
    return {access(depth, Mode::read, Role::sampled), access(hdr, Mode::write, Role::storage)};
  }
};

TEST_F(CompileShaders, CompilesAndFindsStages) {
  compute(depth_to_hdr(), "void main() {\n  ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n  imageStore(hdr, p, texelFetch(depth, p, 0));\n}\n");
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  ASSERT_EQ(bundle.shaders.size(), 1u);
  EXPECT_EQ(bundle.shaders[0].name, "work.comp");
  EXPECT_EQ(bundle.shaders[0].words[0], 0x07230203u);
  EXPECT_EQ(bundle.shaders[0].words[1], 0x00010500u);
  EXPECT_EQ(bundle.passes[0].access_stages, (std::vector<uint32_t>{dsl::stage_compute, dsl::stage_compute}));
  EXPECT_EQ(bundle.read_files, std::vector<std::string>{"work.comp"});
  const dsl::Program resolved = resolve_stages(program, graph_id, bundle);
  EXPECT_EQ(resolved.graphs[graph_id].passes.rows[0].accesses[0].stages, uint32_t{dsl::stage_compute});
}

TEST_F(CompileShaders, SyntaxErrorIsAtTheShadersOwnLine) {
  compute(depth_to_hdr(), "// a comment\nvoid main() {\n  int x = ;\n}\n");
  compile();
  EXPECT_EQ(report(),
            "RG0402 work.comp:3:3 syntax error, unexpected SEMICOLON\n"
            "  RG0450 passes.rg:4:5 shader of pass `work`, named here\n");
}

TEST_F(CompileShaders, ErrorInAnIncludeIsAtItsLine) {
  compute(depth_to_hdr(), "#include \"lib/a.glsl\"\nvoid main() { imageStore(hdr, ivec2(0), vec4(f()) + texelFetch(depth, ivec2(0), 0)); }\n");
  shaders["lib/a.glsl"] = "#include \"b.glsl\"\nfloat f() { return g(); }\n";
  shaders["lib/b.glsl"] = "\nfloat g() { return nothing; }\n";
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(),
            "RG0402 lib/b.glsl:2:20 `nothing`: undeclared identifier\n"
            "  RG0455 passes.rg:3:8 the pass gives it `depth`, `hdr`\n"
            "  RG0450 passes.rg:4:5 shader of pass `work`, named here\n");
  EXPECT_EQ(bundle.read_files, (std::vector<std::string>{"lib/a.glsl", "lib/b.glsl", "work.comp"}));
}

TEST_F(CompileShaders, IncludesAreFoundBesideTheShaderFirst) {
  compute(depth_to_hdr(), "").shaders[0].path = "deep/work.comp";
  shaders = {{"deep/work.comp", "#include \"a.glsl\"\nvoid main() { imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0) + beside); }\n"},
             {"a.glsl", "const float at_root = 1.0;\n"},
             {"deep/a.glsl", "const float beside = 1.0;\n"}};
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  EXPECT_EQ(bundle.read_files, (std::vector<std::string>{"deep/a.glsl", "deep/work.comp"}));
}

TEST_F(CompileShaders, IncludesNeverLeaveTheRoot) {
  compute(depth_to_hdr(), "#include \"../secret.glsl\"\nvoid main() {}\n");
  shaders["../secret.glsl"] = "int secret = 1;\n";
  compile();
  EXPECT_NE(report().find("RG0402 work.comp:1:"), std::string::npos) << report();
}

TEST_F(CompileShaders, ShaderOutsideTheRootIsRefused) {
  compute(depth_to_hdr(), "void main() {}\n").shaders[0].path = "../work.comp";
  compile();
  EXPECT_EQ(report(), "RG0401 passes.rg:4:5 cannot read shader `../work.comp`: it lies outside the root file's folder\n");
}

TEST_F(CompileShaders, MissingShaderFile) {
  compute(depth_to_hdr(), "");
  shaders.clear();
  compile();
  EXPECT_EQ(report(), "RG0401 passes.rg:4:5 cannot read shader `work.comp`: no such file\n");
}

TEST_F(CompileShaders, MissingMain) {
  compute(depth_to_hdr(), "int helper() { return 1; }\n");
  compile();
  EXPECT_EQ(report(), "RG0402 passes.rg:4:5 `work.comp` has no `void main()`\n  RG0450 passes.rg:4:5 shader of pass `work`, named here\n");
}

TEST_F(CompileShaders, UnusedAccess) {
  compute(depth_to_hdr(), "void main() { imageStore(hdr, ivec2(0), vec4(1)); }\n");
  compile();
  EXPECT_EQ(report(),
            "RG0403 passes.rg:5:5 `depth` is declared by pass `work` but none of its shaders uses it\n"
            "  RG0450 passes.rg:4:5 shader of pass `work`, named here\n");
}

TEST_F(CompileShaders, UndeclaredResourceOfTheGraph) {
  image("albedo", Format::rgba8);
  compute(depth_to_hdr(), "void main() {\n  imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0) * texelFetch(albedo, ivec2(0), 0));\n}\n");
  compile();
  EXPECT_EQ(report(),
            "RG0404 work.comp:2:73 `albedo` is used here but pass `work` does not declare it\n"
            "  RG0453 passes.rg:3:8 declare it in the pass, for example `read albedo as sampled`\n");
}

TEST_F(CompileShaders, UndeclaredResourcesAreSuggestedAsTheyAreUsed) {
  const std::pair<const char*, const char*> cases[] = {{"imageStore(albedo, ivec2(0), vec4(1));", "write albedo as storage"},
                                                       {"vec4 v = imageLoad( albedo, ivec2(0));", "read albedo as storage"},
                                                       {"imageAtomicAdd(albedo, ivec2(0), 1u);", "atomic albedo"},
                                                       {"vec4 v = texelFetch(albedo, ivec2(0), 0);", "read albedo as sampled"}};
  for (const auto& [body, declaration] : cases) {
    Fixture f;
    f.image("albedo", Format::rgba8);
    f.compute({f.access(f.image("hdr", Format::rgba16f), Mode::write, Role::storage)},
              std::string("void main() {\n  imageStore(hdr, ivec2(0), vec4(1));\n  ") + body + "\n}\n");
    f.compile();
    EXPECT_NE(f.report().find(std::string("for example `") + declaration + "`"), std::string::npos) << body << "\n" << f.report();
  }
}

TEST_F(CompileShaders, AssignmentsToNoNameNoteTheOutputs) {
  const auto hdr = image("hdr", Format::rgba16f);
  raster({access(hdr, Mode::write, Role::color)}, "void main() { gl_Position = vec4(0); }\n", "void main() {\n  out_color = vec4(1);\n}\n");
  compile();
  EXPECT_EQ(report().substr(0, report().find("  RG0450")),
            "RG0402 draw.frag:2:3 `out_color`: undeclared identifier\n"
            "  RG0451 passes.rg:6:5 `hdr` is declared here\n");
}

TEST_F(CompileShaders, WriteThroughRead) {
  const auto mask = buffer("mask", kUint);
  compute({access(mask, Mode::read, Role::storage)}, "void main() {\n  mask[0] = 1u;\n}\n");
  compile();
  EXPECT_EQ(report(),
            "RG0405 work.comp:2:3 `mask` is written here but pass `work` declares it `read`\n"
            "  RG0451 passes.rg:5:5 `mask` is declared here\n");
}

TEST_F(CompileShaders, WriteToReadOnlyImage) {
  const auto hdr = image("hdr", Format::rgba16f);
  compute({access(hdr, Mode::read, Role::storage)}, "void main() {\n  imageStore(hdr, ivec2(0), vec4(0));\n}\n");
  compile();
  EXPECT_EQ(report().substr(0, 22), "RG0405 work.comp:2:14 ") << report();
}

TEST_F(CompileShaders, ReadsOfAWriteOnlyAccess) {
  const auto mask = buffer("mask", kUint);
  for (const char* body : {"mask[1] = mask[0];", "mask[0] |= 1u;", "atomicOr(mask[0], 1u);"}) {
    Fixture f;
    f.compute({f.access(f.buffer("mask", kUint), Mode::write, Role::storage)}, std::string("void main() {\n  ") + body + "\n}\n");
    f.compile();
    EXPECT_NE(f.report().find("`mask` is read here but pass `work` declares it `write`"), std::string::npos) << body << "\n" << f.report();
    EXPECT_EQ(f.report().substr(0, 19), "RG0406 work.comp:2:") << body;
  }
  EXPECT_TRUE(mask.valid());
}

TEST_F(CompileShaders, LoadAndAtomicOfAWriteOnlyImage) {
  for (const char* body : {"imageStore(ids, ivec2(0), imageLoad(ids, ivec2(1)));", "imageAtomicAdd(ids, ivec2(0), 1u);"}) {
    Fixture f;
    f.compute({f.access(f.image("ids", Format::r32ui), Mode::write, Role::storage)}, std::string("void main() { ") + body + " }\n");
    f.compile();
    EXPECT_EQ(f.report().substr(0, 19), "RG0406 work.comp:1:") << body << "\n" << f.report();
  }
}

TEST_F(CompileShaders, AtomicAccess) {
  const auto mask = buffer("mask", kUint);
  compute({access(mask, Mode::atomic, Role::storage)}, "void main() { atomicOr(mask[3], 1u); }\n");
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  EXPECT_EQ(bundle.passes[0].access_stages[0], uint32_t{dsl::stage_compute});
}

TEST_F(CompileShaders, PlainStoreToAtomic) {
  const auto mask = buffer("mask", kUint);
  compute({access(mask, Mode::atomic, Role::storage)}, "void main() { mask[3] = 1u; }\n");
  compile();
  EXPECT_EQ(report().substr(0, report().find('\n')),
            "RG0407 work.comp:1:15 `mask` is written here without an atomic operation but pass `work` declares it `atomic`");
}

TEST_F(CompileShaders, UpdateThatOnlyReadsIsAWarning) {
  const auto mask = buffer("mask", kUint), sum = buffer("sum", kUint);
  compute({access(mask, Mode::update, Role::storage), access(sum, Mode::write, Role::storage)}, "void main() { sum[0] = mask[0]; }\n");
  compile();
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(report().substr(0, report().find('\n')), "RG0408 passes.rg:6:5 `mask` is declared `update` by pass `work` but its shaders only read it");
}

TEST_F(CompileShaders, LocalSizeComesFromThePass) {
  compute(depth_to_hdr(), "layout(local_size_x = 64) in;\nvoid main() { imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0)); }\n");
  compile();
  EXPECT_EQ(report(),
            "RG0411 work.comp:1:1 the shader sets a local size other than `group` of pass `work`\n"
            "  RG0454 passes.rg:3:8 the local size comes from the pass: write `group` after its shader\n");
}

TEST_F(CompileShaders, OwnDescriptor) {
  compute(depth_to_hdr(),
          "layout(set = 1, binding = 7) uniform texture2D mine;\n"
          "void main() { imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0) + texelFetch(mine, ivec2(0), 0)); }\n");
  compile();
  EXPECT_EQ(report().substr(0, report().find('\n')), "RG0413 work.comp:1:48 the shader declares `mine` in set 1 by itself, past pass `work`");
}

TEST_F(CompileShaders, NameThatGlslRefuses) {
  auto accesses = depth_to_hdr();
  accesses[0].name = "sampler";
  compute(accesses, "void main() {}\n");
  compile();
  EXPECT_EQ(report().substr(0, 20), "RG0414 passes.rg:5:5") << report();
}

TEST_F(CompileShaders, DeclaredStagesMustHoldTheRealOnes) {
  const auto hdr = image("hdr", Format::rgba16f), table = buffer("table", kUint);
  auto read = access(table, Mode::read, Role::storage);
  read.stages = dsl::stage_fragment;
  raster({access(hdr, Mode::write, Role::color), read}, "void main() { gl_Position = vec4(table[0]); }\n", "void main() { hdr = vec4(table[1]); }\n");
  compile();
  EXPECT_EQ(report(),
            "RG0410 passes.rg:5:5 `table` is used by the vertex shader but pass `draw` declares it in `fragment`\n"
            "  RG0452 draw.vert:1:34 `table` is used here\n");
}

TEST_F(CompileShaders, StagesAreExact) {
  const auto hdr = image("hdr", Format::rgba16f), a = buffer("a", kUint), b = buffer("b", kUint);
  raster({access(hdr, Mode::write, Role::color), access(a, Mode::read, Role::storage), access(b, Mode::read, Role::storage)},
         "void main() { gl_Position = vec4(a[0]); }\n", "void main() { hdr = vec4(b[0] + a[1]); }\n");
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  EXPECT_EQ(bundle.passes[0].access_stages, (std::vector<uint32_t>{0, dsl::stage_vertex | dsl::stage_fragment, dsl::stage_fragment}));
}

TEST_F(CompileShaders, FullscreenGetsItsVertexShader) {
  const auto hdr = image("hdr", Format::rgba16f);
  raster({access(hdr, Mode::write, Role::color)}, "", "void main() { hdr = vec4(uv, 0, 1); }\n").draw.kind = dsl::DrawKind::fullscreen;
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  ASSERT_EQ(bundle.passes[0].shaders.size(), 2u);
  EXPECT_EQ(bundle.shaders[bundle.passes[0].shaders[0]].stage, dsl::stage_vertex);
  EXPECT_EQ(bundle.shaders[bundle.passes[0].shaders[0]].name, "rgc/fullscreen.vert");
}

TEST_F(CompileShaders, FragmentWithoutVertex) {
  const auto hdr = image("hdr", Format::rgba16f);
  raster({access(hdr, Mode::write, Role::color)}, "", "void main() { hdr = vec4(1); }\n");
  compile();
  EXPECT_EQ(report(), "RG0412 passes.rg:4:5 pass `draw` names no vertex shader\n");
}

TEST_F(CompileShaders, OutputNotWritten) {
  const auto hdr = image("hdr", Format::rgba16f), ids = image("ids", Format::r32ui);
  raster({access(hdr, Mode::write, Role::color), access(ids, Mode::write, Role::color)}, "void main() { gl_Position = vec4(0); }\n",
         "void main() { hdr = vec4(1); }\n");
  compile();
  EXPECT_EQ(report().substr(0, report().find('\n')), "RG0409 passes.rg:6:5 colour `ids` of pass `draw` is written by no fragment shader");
}

TEST_F(CompileShaders, OutputThatNoAttachmentTakes) {
  const auto hdr = image("hdr", Format::rgba16f);
  raster({access(hdr, Mode::write, Role::color)}, "void main() { gl_Position = vec4(0); }\n",
         "layout(location = 2) out vec3 bright;\nlayout(location = 3) out float unused;\nvoid main() { hdr = vec4(1); bright = vec3(2); }\n");
  compile();
  EXPECT_EQ(
      report().substr(0, report().find('\n')),
      "RG0418 draw.frag:1:31 the shader writes `bright` to location 2, and pass `draw` has 1 colour: what is written there is lost; declare another "
      "`color`");
}

TEST_F(CompileShaders, ColourWithoutFragmentShader) {
  const auto hdr = image("hdr", Format::rgba16f);
  raster({access(hdr, Mode::write, Role::color)}, "void main() { gl_Position = vec4(0); }\n", "");
  compile();
  EXPECT_EQ(report().substr(0, report().find('\n')), "RG0409 passes.rg:6:5 colour `hdr` of pass `draw` is written by no fragment shader");
}

TEST_F(CompileShaders, LoopInstancesShareOneModule) {
  compute(depth_to_hdr(), "void main() { imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0)); }\n");
  dsl::Pass second = graph().passes.rows[0];
  second.name = "work[2]";
  graph().passes.add(second);
  const ShaderBundle bundle = compile();
  EXPECT_EQ(bundle.shaders.size(), 1u);
  EXPECT_EQ(bundle.passes[0].shaders, bundle.passes[1].shaders);
}

TEST_F(CompileShaders, OneFileBehindTwoInterfacesIsTwoModules) {
  const auto accesses = depth_to_hdr();
  compute(accesses, "void main() { imageStore(hdr, ivec2(0), texelFetch(depth, ivec2(0), 0)); }\n");
  dsl::Pass second = graph().passes.rows[0];
  second.dispatch.group[0] = 4;
  graph().passes.add(second);
  const ShaderBundle bundle = compile();
  ASSERT_EQ(bundle.shaders.size(), 2u);
  EXPECT_EQ(bundle.shaders[1].name, "work.comp.2");
}

TEST_F(CompileShaders, SameInputSameBytes) {
  const auto accesses = depth_to_hdr();
  for (int i = 0; i < 8; ++i) {
    dsl::Pass& pass = compute(accesses, "");
    pass.shaders[0].path = "s" + std::to_string(i) + ".comp";
    shaders[pass.shaders[0].path] =
        "void main() { imageStore(hdr, ivec2(" + std::to_string(i) + "), sin(texelFetch(depth, ivec2(0), 0)) * " + std::to_string(i) + ".0); }\n";
  }
  const ShaderBundle first = compile(), second = compile();
  ASSERT_EQ(first.shaders.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(first.shaders[i].name, second.shaders[i].name);
    EXPECT_EQ(first.shaders[i].words, second.shaders[i].words);
  }
}

TEST_F(CompileShaders, PassesRecordedByTheHostKeepTheirDeclaredStages) {
  const auto hdr = image("hdr", Format::rgba16f), a = buffer("a", kUint), b = buffer("b", kUint);
  auto in_vertex = access(a, Mode::read, Role::storage);
  in_vertex.stages = dsl::stage_vertex;
  raster({access(hdr, Mode::write, Role::color), in_vertex, access(b, Mode::read, Role::storage)}, "", "");
  const ShaderBundle bundle = compile();
  EXPECT_EQ(report(), "");
  EXPECT_TRUE(bundle.passes[0].shaders.empty());
  EXPECT_EQ(bundle.passes[0].access_stages, (std::vector<uint32_t>{0, dsl::stage_vertex, dsl::stage_fragment}));
}

}  // namespace
}  // namespace rg::compiler
