// Whose order nobody can tell: small programs by hand. `a` and `b` change places, what follows stays.
#include "compiler/verify/exchange.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/verify/builder.h"

namespace rg::verify {
namespace {

using dsl::Role;

struct Exchanging : Builder {
  dsl::ResourceId image(uint32_t mips, uint32_t layers = 1, dsl::Format format = dsl::Format::rgba16f) {
    const dsl::ResourceId id = Builder::image("i", format, mips, layers);
    return lifetime(id, dsl::Lifetime::transient), id;
  }
  dsl::ResourceId buffer(int64_t bytes = 256) {
    const dsl::ResourceId id = Builder::buffer("b", bytes);
    return lifetime(id, dsl::Lifetime::transient), id;
  }
  Do bytes(Do access, int64_t offset, int64_t size) {
    access.range.offset = program_constant(offset), access.range.size = program_constant(size);
    return access;
  }
  dsl::ExprId width() { return program.exprs.add({dsl::ExprOp::extent, {}, {}, 0}); }
  void limit(dsl::PassId pass, dsl::ResourceId image, uint32_t mip) { graph().passes[pass].mip_limits.push_back({image, mip}); }

  // The first two passes change places.
  bool may() {
    std::vector<uint32_t> rest(graph().passes.size() - 2);
    std::iota(rest.begin(), rest.end(), 2u);
    return may_exchange(program, graph(), 0, 1, rest);
  }
};

TEST(Exchange, ReaderTellsWhoWroteLast) {
  Exchanging c;
  const auto b = c.buffer();
  c.compute("a", {writes(b)});
  c.compute("b", {writes(b)});
  EXPECT_TRUE(c.may()) << "nobody looks";
  c.compute("read", {reads(b)});
  EXPECT_FALSE(c.may());
}

TEST(Exchange, WriterAndReader) {
  Exchanging c;
  const auto b = c.buffer(), other = c.buffer();
  c.compute("a", {writes(b)});
  c.compute("b", {reads(b), writes(other)});
  EXPECT_FALSE(c.may()) << "what the reader finds is what it makes";
}

TEST(Exchange, ReadersDoNotMind) {
  Exchanging c;
  const auto b = c.buffer();
  c.compute("a", {reads(b)});
  c.compute("b", {reads(b)});
  c.compute("read", {reads(b)});
  EXPECT_TRUE(c.may());
}

TEST(Exchange, WhatOutlivesTheFrameIsSeen) {
  for (const dsl::Lifetime lifetime :
       {dsl::Lifetime::transient, dsl::Lifetime::history, dsl::Lifetime::persistent, dsl::Lifetime::imported, dsl::Lifetime::readback}) {
    Exchanging c;
    const auto b = c.buffer();
    c.lifetime(b, lifetime, 1);
    c.source(b).after.role = Role::storage;
    c.compute("a", {writes(b)});
    c.compute("b", {writes(b)});
    EXPECT_EQ(c.may(), lifetime == dsl::Lifetime::transient) << static_cast<int>(lifetime);
    c.source(b).is_output = true;
    EXPECT_FALSE(c.may());
  }
}

// As in random graph 8,246: one writes a mip, the other the whole image, and only that mip is written by both.
TEST(Exchange, OnlyWhatBothWroteCounts) {
  Exchanging c;
  const auto i = c.image(3), other = c.buffer();
  c.compute("a", {writes(i).mip(0)});
  c.compute("b", {writes(i)});
  c.compute("again", {writes(i).mip(0)});
  c.raster("read", {reads(i, Role::sampled).mip(1), writes(other)});
  EXPECT_TRUE(c.may());
  c.raster("read too", {reads(i, Role::sampled).mip(0), writes(other)});
  EXPECT_TRUE(c.may()) << "it was written again";
}

TEST(Exchange, PartsAreWrittenByDifferentPasses) {
  for (const uint32_t second : {0u, 1u}) {
    Exchanging c;
    const auto i = c.image(1, 2);
    c.compute("a", {writes(i)});
    c.compute("b", {writes(i)});
    c.compute("one", {writes(i).layer(0)});
    c.compute("two", {writes(i).layer(second)});
    c.compute("read", {reads(i)});
    EXPECT_EQ(c.may(), second == 1);
  }
}

TEST(Exchange, AspectsAreApart) {
  Exchanging c;
  const auto i = c.image(1, 1, dsl::Format::d32f_s8);
  c.raster("a", {writes(i, Role::depth).cleared()});
  c.raster("b", {writes(i, Role::stencil).cleared()});
  c.raster("read", {reads(i, Role::depth_readonly)});
  EXPECT_TRUE(c.may());
  c.graph().passes.rows[0].accesses[0].range.aspects = 6;
  EXPECT_TRUE(c.may()) << "nobody tests the stencil";
  c.graph().passes.rows[2].accesses[0].range.aspects = 6;
  EXPECT_FALSE(c.may());
}

TEST(Exchange, BytesThatMeetAreNotTheSame) {
  for (const int64_t offset : {0, 64, 128}) {
    Exchanging c;
    const auto b = c.buffer();
    c.compute("a", {c.bytes(writes(b), 0, 128)});
    c.compute("b", {c.bytes(writes(b), offset, 128)});
    c.compute("read", {reads(b)});
    EXPECT_EQ(c.may(), offset == 128) << offset;
  }
}

TEST(Exchange, HalvesCoverTheWhole) {
  for (const int64_t size : {128, 64}) {
    Exchanging c;
    const auto b = c.buffer();
    c.compute("a", {writes(b)});
    c.compute("b", {writes(b)});
    c.compute("lower", {c.bytes(writes(b), 0, 128)});
    c.compute("upper", {c.bytes(writes(b), 128, size)});
    c.compute("read", {reads(b)});
    EXPECT_EQ(c.may(), size == 128);
  }
}

// Bytes that depend on an extent may be any: they meet whatever there is, and cover nothing.
TEST(Exchange, BytesOfAnyPlace) {
  Exchanging c;
  const auto b = c.buffer();
  c.compute("a", {c.bytes(writes(b), 0, 64)});
  c.compute("b", {writes(b)});
  c.compute("again", {writes(b)});
  c.compute("read", {c.bytes(reads(b), 0, 64)});
  const auto range = [&](uint32_t pass) -> dsl::Range& { return c.graph().passes.rows[pass].accesses[0].range; };
  range(1).offset = range(1).size = range(2).offset = range(2).size = c.width();
  EXPECT_FALSE(c.may());
  range(2) = {};
  EXPECT_TRUE(c.may()) << "all of the buffer is written again";
}

TEST(Exchange, LengthThatDependsOnAnExtent) {
  Exchanging c;
  const auto b = c.buffer();
  c.source(b).count = c.width();
  c.compute("a", {writes(b)});
  c.compute("b", {writes(b)});
  c.compute("again", {c.bytes(writes(b), 0, 128)});
  c.compute("read", {reads(b)});
  EXPECT_FALSE(c.may());
  c.graph().passes.rows[2].accesses[0].range.size = {};
  EXPECT_TRUE(c.may());
}

TEST(Exchange, UpdateAndDisjointWritersKeepSome) {
  for (const bool disjoint : {false, true}) {
    Exchanging c;
    const auto b = c.buffer();
    c.compute("a", {writes(b)});
    c.compute("b", {writes(b)});
    c.compute("next", {disjoint ? writes(b).apart() : updates(b)});
    EXPECT_FALSE(c.may());
  }
}

TEST(Exchange, AttachmentThatIsNeitherClearedNorCoveredKeepsSome) {
  for (const bool cleared : {false, true}) {
    Exchanging c;
    const auto i = c.image(1);
    c.compute("a", {writes(i)});
    c.compute("b", {writes(i)});
    c.raster("draw", {cleared ? writes(i, Role::color).cleared() : writes(i, Role::color)});
    EXPECT_EQ(c.may(), cleared);
  }
}

TEST(Exchange, CommutingWriters) {
  Exchanging c;
  const auto b = c.buffer();
  c.compute("a", {counts(b)});
  c.compute("b", {counts(b)});
  c.compute("read", {reads(b)});
  EXPECT_TRUE(c.may());
  c.graph().passes.rows[1].accesses[0].mode = dsl::Mode::update;
  EXPECT_FALSE(c.may());
}

TEST(Exchange, WriterThatMayBeSkippedReplacesNothing) {
  Exchanging c;
  const auto b = c.buffer();
  const auto first = c.compute("a", {writes(b)});
  c.compute("b", {writes(b)});
  const auto again = c.compute("again", {writes(b)});
  const auto read = c.compute("read", {reads(b)});
  EXPECT_TRUE(c.may());
  const dsl::ConditionId night{size_t{0}}, dry{size_t{1}};
  const auto runs_if = [&](dsl::PassId pass, const std::vector<dsl::ConditionId>& conditions) { c.graph().passes[pass].conditions = conditions; };
  runs_if(again, {night});
  EXPECT_FALSE(c.may());
  runs_if(read, {dry});
  EXPECT_FALSE(c.may()) << "by day, nobody has written again";
  runs_if(read, {night, dry});
  EXPECT_TRUE(c.may()) << "the reader runs only where it was";
  runs_if(read, {});
  runs_if(first, {night});
  EXPECT_TRUE(c.may()) << "by day only one of them runs";
  runs_if(again, {night, dry});
  EXPECT_FALSE(c.may());
}

TEST(Exchange, MipThatIsThereIsWritten) {
  for (const uint32_t mip : {1u, 2u}) {
    Exchanging c;
    const auto i = c.image(3);
    c.compute("a", {writes(i).mip(1)});
    c.compute("b", {writes(i).mip(1)});
    c.limit(c.compute("again", {writes(i).mip(1)}), i, mip);
    c.compute("read", {reads(i).mip(1)});
    EXPECT_EQ(c.may(), mip == 1) << "a pass for the next mip may be skipped though this one exists";
  }
}

TEST(Exchange, OtherVersionsAreOtherPlaces) {
  Exchanging c;
  const auto b = c.buffer(), other = c.buffer();
  c.lifetime(b, dsl::Lifetime::history, 1);
  c.compute("a", {writes(b)});
  c.compute("b", {reads(b).prev(1), writes(other)});
  EXPECT_TRUE(c.may());
}

}  // namespace
}  // namespace rg::verify
