// What commands write is never what they read, nothing twice, and nothing that is no plain file.
#include "compiler/commands/outputs.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "tests/unit/driver/in_folder.h"

namespace rg::commands {
namespace {

namespace fs = std::filesystem;
using dsl::DiagnosticKind;

class Outputs : public InFolder {
 protected:
  // The kind that is reported, if any.
  std::optional<DiagnosticKind> judge(const std::vector<Output>& named, const std::vector<compiler::GeneratedFile>& files = {}) const {
    dsl::Diagnostics diagnostics;
    const bool good = may_write(named, outputs_in(path("out"), files), {path("a.rg"), path("nothing.rg")}, diagnostics);
    EXPECT_EQ(good, diagnostics.rows().empty());
    return diagnostics.rows().empty() ? std::nullopt : std::optional(diagnostics.rows()[0].kind);
  }
  mode_t mode(const std::string& name) const {
    struct stat about {};
    EXPECT_EQ(::stat(path(name).c_str(), &about), 0);
    return about.st_mode & 07777;
  }
};

TEST_F(Outputs, AreNoInputsUnderWhateverName) {
  put("a.rg", "source");
  fs::create_symlink("a.rg", path("link"));
  fs::create_hard_link(path("a.rg"), path("twin"));
  for (const char* name : {"a.rg", "./a.rg", "link", "twin"}) EXPECT_EQ(judge({{"the stamp", path(name)}}), DiagnosticKind::OutputIsInput) << name;
  fs::create_directory(path("out"));
  fs::create_symlink(path("a.rg"), path("out/x.h"));
  EXPECT_EQ(judge({}, {{"x.h", ""}}), DiagnosticKind::OutputIsInput);
  EXPECT_EQ(judge({{"the stamp", path("nothing.rg")}}), std::nullopt);  // it was read from elsewhere
  EXPECT_EQ(judge({{"the stamp", path("new")}}), std::nullopt);
}

TEST_F(Outputs, StandOnlyOnce) {
  put("a.rg", "source");
  fs::create_symlink("new", path("link"));
  const Output stamp{"the stamp", path("new")};
  for (const char* name : {"new", "./new", "out/../new", "link"})
    EXPECT_EQ(judge({stamp, {"the depfile", path(name)}}), DiagnosticKind::OutputTwice) << name;
  EXPECT_EQ(judge({{"the plan file", path("out/x.h")}}, {{"x.h", ""}}), DiagnosticKind::OutputTwice);
  EXPECT_EQ(judge({{"the plan file", path("out/manifest.txt")}}, {}), DiagnosticKind::OutputTwice);
  EXPECT_EQ(judge({stamp, {"the depfile", path("out/new")}}, {{"x.h", ""}}), std::nullopt);
}

TEST_F(Outputs, ReplaceNothingButFiles) {
  fs::create_directory(path("folder"));
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0666), 0);
  put("kept", "old");
  fs::permissions(path("kept"), fs::perms(0444));
  for (const char* name : {"folder", "pipe", "kept"}) {
    EXPECT_EQ(judge({{"the stamp", path(name)}}), DiagnosticKind::OutputNotWritable) << name;
    dsl::Diagnostics diagnostics;
    EXPECT_FALSE(write_file(path(name), "new", diagnostics)) << name;
    EXPECT_FALSE(touch_file(path(name), diagnostics)) << name;
    EXPECT_FALSE(write_output(path("out"), {{"a.h", "1"}}, diagnostics, {{path(name), "new"}})) << name;
    for (const dsl::Diagnostic& each : diagnostics.rows()) EXPECT_EQ(each.kind, DiagnosticKind::OutputNotWritable);
  }
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_EQ(get("kept"), "old");
  EXPECT_EQ(mode("kept"), 0444u);
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(Outputs, LinksAreFollowedAndModesKept) {
  fs::create_directory(path("deep"));
  put("deep/file", "old");
  fs::permissions(path("deep/file"), fs::perms(0640));
  fs::create_symlink("deep/file", path("near"));
  fs::create_symlink(path("near"), path("far"));
  dsl::Diagnostics diagnostics;
  EXPECT_TRUE(write_file(path("far"), "new", diagnostics));
  EXPECT_EQ(get("deep/file"), "new");
  EXPECT_EQ(mode("deep/file"), 0640u);
  EXPECT_TRUE(fs::is_symlink(path("far")) && fs::is_symlink(path("near")));
  ASSERT_TRUE(write_output(path("out"), {{"a.h", "1"}}, diagnostics, {{path("near"), "newer"}}));
  EXPECT_EQ(get("deep/file"), "newer");
  fs::create_symlink("missing", path("dangling"));
  EXPECT_TRUE(write_file(path("dangling"), "made", diagnostics));
  EXPECT_EQ(get("missing"), "made");
  fs::create_symlink("loop", path("loop"));
  EXPECT_FALSE(write_file(path("loop"), "made", diagnostics));
}

TEST_F(Outputs, AGeneratedFileTakesThePlaceOfALink) {
  put("mine", "mine");
  dsl::Diagnostics diagnostics;
  ASSERT_TRUE(write_output(path("out"), {{"a.h", "1"}}, diagnostics));
  fs::remove(path("out/a.h"));
  fs::create_symlink(path("mine"), path("out/a.h"));
  ASSERT_TRUE(write_output(path("out"), {{"a.h", "2"}}, diagnostics));
  EXPECT_EQ(get("mine"), "mine");
  EXPECT_FALSE(fs::is_symlink(path("out/a.h")));
}

TEST_F(Outputs, WhatWasReadIsNotRemovedAsStale) {
  dsl::Diagnostics diagnostics;
  ASSERT_TRUE(write_output(path("out"), {{"a.h", "1"}, {"b.h", "1"}, {"c.h", "1"}}, diagnostics));
  const auto written = write_output(path("out"), {}, diagnostics, {{path("out/b.h"), "2"}}, {path("out/./a.h")});
  ASSERT_TRUE(written);
  EXPECT_EQ(written->removed, std::vector<std::string>{"c.h"});
  EXPECT_EQ(get("out/a.h"), "1");
  EXPECT_EQ(get("out/b.h"), "2");
}

TEST_F(Outputs, NamesWithControlsAreNotRead) {
  std::string why;
  put("a\nb.rg", "module m");
  EXPECT_FALSE(read_file(path("a\nb.rg"), why));
  EXPECT_EQ(why, "there is a control character in its name");
}

}  // namespace
}  // namespace rg::commands
