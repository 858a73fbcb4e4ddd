// Plans as data: what was written is read back, and nothing else is accepted.
#include "runtime/plan_file.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "compiler/codegen/plan_file.h"
#include "runtime/plan_fields.h"
#include "runtime/plan_interface.h"
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

using compiler::emit_plan_file;

std::string file_of(test::TestPlan& plan) {
  const Plan view = plan.view();
  return emit_plan_file({&view, 1});
}
Result<PlanFile> parse(const std::string& text) { return PlanFile::parse(std::as_bytes(std::span(text)), "x.rgplan"); }
std::string refusal(const std::string& text) {
  const auto parsed = parse(text);
  if (parsed) return "accepted";
  EXPECT_EQ(parsed.error().code, ErrorCode::invalid_plan);
  return parsed.error().message;
}

// The header again, right for what follows it: what a checksum cannot catch.
std::string sealed(std::string file) {
  const std::string_view body = std::string_view(file).substr(plan_file::kHeaderBytes);
  const uint64_t numbers[] = {body.size(), plan_file::checksum(body)};
  std::memcpy(file.data() + 24, numbers, sizeof numbers);
  return file;
}

TEST(PlanFileTest, HoldsWhatWasWritten) {
  test::Tint t = test::tint();
  const std::string file = file_of(t.plan);
  const auto parsed = parse(file);
  ASSERT_TRUE(parsed) << parsed.error().message;
  ASSERT_EQ(parsed->plans().size(), 1u);
  EXPECT_EQ(emit_plan_file(parsed->plans()), file);  // every field came through
  const Plan& plan = parsed->plans()[0];
  EXPECT_EQ(plan.name, "test");
  EXPECT_EQ(plan.resources[t.scene].name, "scene");
  EXPECT_EQ(plan.shaders[0].words.size(), t.plan.shaders[0].words.size());
  EXPECT_EQ(parsed->find("test"), &plan);
  EXPECT_EQ(parsed->find("other"), nullptr);
  EXPECT_EQ(parsed->find("test", "fog=on"), nullptr);
}

TEST(PlanFileTest, EqualShadersAreStoredOnce) {
  test::Counter t = test::counter();
  const Plan one = t.plan.view();
  const Plan two[] = {one, one};
  const size_t words = one.shaders[0].words.size_bytes();
  const size_t single = emit_plan_file({&one, 1}).size(), both = emit_plan_file(two).size();
  EXPECT_LT(both, 2 * single - words);
  const std::string file = emit_plan_file(two);
  const auto parsed = parse(file);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->plans()[0].shaders[0].words.data(), parsed->plans()[1].shaders[0].words.data());
}

TEST(PlanFileTest, RunsAsTheCompiledPlanDoes) {
  const auto frame_of = [](const Plan& plan) {
    std::string log;
    Device device = Device::null(&log);
    auto graph = GraphInstance::create(device, plan, {});
    EXPECT_TRUE(graph && graph->execute({}));
    return log;
  };
  test::ClearAndCopy t = test::clear_and_copy();
  const auto parsed = parse(file_of(t.plan));
  ASSERT_TRUE(parsed);
  EXPECT_EQ(frame_of(parsed->plans()[0]), frame_of(t.plan.view()));
}

TEST(PlanFileTest, RefusesOtherFilesAndOtherVersions) {
  test::ClearAndCopy t = test::clear_and_copy();
  const std::string file = file_of(t.plan);
  EXPECT_EQ(refusal(""), "`x.rgplan` is refused: it ends too early");
  EXPECT_EQ(refusal("#!/bin/sh\necho"), "`x.rgplan` is refused: it is no plan file");
  std::string other = file;
  other[12] = 9;  // kPlanVersion
  EXPECT_EQ(refusal(other),
            "`x.rgplan` is refused: it was written by another version of rgc (plans of version 9); write it again with the rgc that this "
            "runtime came with");
  other = file, other[16] ^= 1;  // kPlanShape
  EXPECT_NE(refusal(other).find("another version of rgc"), std::string::npos);
  EXPECT_EQ(refusal(file + "x"), "`x.rgplan` is refused: something follows its end");
}

TEST(PlanFileTest, RefusesEveryTruncationAndEveryFlippedByte) {
  test::Counter t = test::counter();
  const std::string file = file_of(t.plan);
  for (size_t size = 0; size < file.size(); ++size) ASSERT_EQ(refusal(file.substr(0, size)), "`x.rgplan` is refused: it ends too early") << size;
  for (size_t at = 0; at < file.size(); ++at) {
    std::string damaged = file;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    ASSERT_FALSE(parse(damaged)) << at;
  }
}

TEST(PlanFileTest, AWrongPlanBehindARightChecksumIsRefused) {
  test::ClearAndCopy t = test::clear_and_copy();
  t.plan.image_barriers[0].image.resource = 99;
  EXPECT_EQ(refusal(file_of(t.plan)), "`x.rgplan` is refused: plan `test`: image barrier 0: image");
  test::Counter c = test::counter();
  std::string file = file_of(c.plan);
  file[plan_file::kHeaderBytes + 3] = '\x7f';  // the count of modules
  EXPECT_EQ(refusal(sealed(file)), "`x.rgplan` is refused: it ends too early");
  file = file_of(c.plan);
  file += "more";
  EXPECT_EQ(refusal(sealed(file)), "`x.rgplan` is refused: something follows its last plan");
  EXPECT_EQ(refusal(emit_plan_file({})), "`x.rgplan` is refused: it holds no plan");
}

class PlanWatchTest : public testing::Test {
 protected:
  std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("plan_watch_" + std::to_string(::getpid()));
  std::string path = (folder / "a.rgplan").string();
  PlanWatchTest() { std::filesystem::create_directories(folder); }
  ~PlanWatchTest() override { std::filesystem::remove_all(folder); }
  void write(const std::string& to, const std::string& text) const { std::ofstream(to, std::ios::binary) << text; }
};

TEST_F(PlanWatchTest, ReportsEachChangeOnce) {
  test::Counter t = test::counter();
  const std::string good = file_of(t.plan);
  PlanWatch watch(path);
  EXPECT_FALSE(watch.poll());  // there is no file
  write(path, good);
  auto first = watch.poll();
  ASSERT_TRUE(first && *first);
  EXPECT_FALSE(watch.poll());
  write(path, good.substr(0, good.size() / 2));  // a writer that is not done
  auto half = watch.poll();
  ASSERT_TRUE(half && !*half);
  EXPECT_NE(half->error().message.find("ends too early"), std::string::npos);
  EXPECT_FALSE(watch.poll());
  write(path, good);
  auto whole = watch.poll();
  EXPECT_TRUE(whole && *whole);
  std::filesystem::remove(path);  // an editor that renames: gone for a moment
  EXPECT_FALSE(watch.poll());
  write(path + ".new", good);
  std::filesystem::rename(path + ".new", path);
  auto renamed = watch.poll();
  EXPECT_TRUE(renamed && *renamed);
}

TEST_F(PlanWatchTest, KnowsTheFileThatWasThere) {
  test::Counter t = test::counter();
  write(path, file_of(t.plan));
  PlanWatch knows(path), reports(path, true);
  EXPECT_FALSE(knows.poll());
  EXPECT_TRUE(reports.poll());
  EXPECT_EQ(PlanFile::read(path + "x").error().code, ErrorCode::io);
  EXPECT_EQ(PlanFile::read(folder.string()).error().message, "`" + folder.string() + "` is not a file");
}

// ---- does it fit the program? -------------------------------------------------------------------------------------

constexpr Feature kPath[] = {{"path", 3, 0, Capability::none, 77}}, kFewer[] = {{"path", 2, 0, Capability::none, 77}},
                  kReordered[] = {{"path", 3, 0, Capability::none, 78}};

template <class Change>
std::string difference(Change change) {
  test::Tint built = test::tint(), loaded = test::tint();
  for (test::Tint* t : {&built, &loaded}) {
    t->plan.conditions = {"moved"};
    t->plan.params.push_back({"camera", 16, kNone, 5});
    t->plan.base.features = kPath;
  }
  change(loaded);
  return test::message(check_interface(built.plan.view(), loaded.plan.view()));
}

TEST(PlanInterface, WhatLiesInsideMayChange) {
  EXPECT_EQ(difference([](test::Tint&) {}), "no error");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.resources[t.final].format = test::kR32f; }), "no error");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.passes[t.tint].name = "colour"; }), "no error");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.conditions.clear(); }), "no error");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.base.features = {}; }), "no error");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.params.clear(); }), "no error");
}

TEST(PlanInterface, WhatTheProgramBringsMayNot) {
  const std::string what = "the plan of `test` does not fit this program: ",
                    way_out = "; build the program again with the generated code of the plan";
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.base.name = "other"; }), "the plan is one of graph `other`; this program runs `test`");
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.extents.push_back({"froxels", 3}); }), what + "extent `froxels` is new" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.extents.clear(); }), what + "extent `view` is gone" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.params[0].layout = 6; }), what + "parameter block `camera` changed" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.params[0].name = "fog"; }), what + "parameter block `fog` stands where `camera` was" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.conditions.insert(t.plan.conditions.begin(), "dark"); }),
            what + "condition `dark` stands where `moved` was" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.passes[t.draw].name = "draw_all"; }),
            what + "host pass `draw_all` stands where `draw` was" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.base.features = kFewer; }), what + "feature `path` changed" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.base.features = kReordered; }),
            what + "feature `path` has values of other names, or in another order" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) { t.plan.passes[t.draw].push_layout = 3; }), what + "host pass `draw` has other push constants" + way_out);
  EXPECT_EQ(difference([](test::Tint& t) {
              t.plan.resources[t.final].lifetime = Lifetime::imported;
              t.plan.resources[t.final].import_slot = 0;
            }),
            what + "import `final` is new" + way_out);
}

}  // namespace
}  // namespace rg
