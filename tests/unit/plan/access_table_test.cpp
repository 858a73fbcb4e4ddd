// Roles in Vulkan's terms, and the logical order of stages.
#include "compiler/access_table.h"

#include <gtest/gtest.h>

namespace rg::compiler {
namespace {

Effect effect(dsl::Role role, dsl::Mode mode, dsl::PassKind kind = dsl::PassKind::compute, uint32_t aspect = aspect_color) {
  dsl::Pass pass;
  pass.kind = kind;
  dsl::Access access;
  access.role = role, access.mode = mode;
  return effect_of(pass, access, aspect);
}

TEST(AccessTable, StorageFollowsTheMode) {
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::read).reads, access::shader_storage_read);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::write).writes, access::shader_storage_write);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::write).reads, access::none);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::atomic).reads, access::shader_storage_read);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::read).layout, Layout::general);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::read).stages(), stage::compute_shader);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::read, dsl::PassKind::raster).stages(), stage::fragment_shader);
}

TEST(AccessTable, AspectsHaveTheirOwnLayouts) {
  EXPECT_EQ(effect(dsl::Role::sampled, dsl::Mode::read).layout, Layout::shader_read_only);
  EXPECT_EQ(effect(dsl::Role::sampled, dsl::Mode::read, dsl::PassKind::compute, aspect_depth).layout, Layout::depth_read_only);
  EXPECT_EQ(effect(dsl::Role::depth_readonly, dsl::Mode::read, dsl::PassKind::raster, aspect_depth).layout, Layout::depth_read_only);
  EXPECT_EQ(effect(dsl::Role::stencil, dsl::Mode::update, dsl::PassKind::raster, aspect_stencil).layout, Layout::stencil_attachment);
  EXPECT_EQ(effect(dsl::Role::storage, dsl::Mode::read, dsl::PassKind::compute, 0).layout, Layout::undefined) << "buffers have none";
}

TEST(AccessTable, ResolveIsOutputInARenderingAndACommandElsewhere) {
  EXPECT_EQ(effect(dsl::Role::resolve_dst, dsl::Mode::write, dsl::PassKind::raster).stages(), stage::color_attachment_output);
  EXPECT_EQ(effect(dsl::Role::resolve_dst, dsl::Mode::write, dsl::PassKind::transfer).stages(), stage::resolve);
  EXPECT_EQ(effect(dsl::Role::resolve_dst, dsl::Mode::write, dsl::PassKind::transfer).layout, Layout::transfer_dst);
}

TEST(AccessTable, ColourIsReadOnlyWhereItLoadsOrBlends) {
  dsl::Pass pass;
  pass.kind = dsl::PassKind::raster;
  dsl::Access access;
  access.role = dsl::Role::color, access.mode = dsl::Mode::update;
  EXPECT_EQ(effect_of(pass, access, aspect_color).reads, access::color_attachment_read);
  access.clear = dsl::ClearValue{};
  EXPECT_EQ(effect_of(pass, access, aspect_color).reads, access::none);
  access.blend.enabled = true;
  EXPECT_EQ(effect_of(pass, access, aspect_color).reads, access::color_attachment_read);
  EXPECT_FALSE(needs_contents(pass, access)) << "it blends onto its own clear";
}

TEST(AccessTable, StagesStandForTheirLogicalNeighbours) {
  EXPECT_EQ(latest_stages(stage::fragment_shader | stage::color_attachment_output), stage::color_attachment_output);
  EXPECT_EQ(latest_stages(stage::fragment_shader | stage::compute_shader), stage::fragment_shader | stage::compute_shader);
  EXPECT_EQ(latest_stages(stage::draw_indirect | stage::compute_shader), stage::compute_shader);
  EXPECT_EQ(earliest_stages(stage::early_fragment_tests | stage::late_fragment_tests), stage::early_fragment_tests);
  EXPECT_EQ(earliest_stages(stage::vertex_shader | stage::compute_shader), stage::vertex_shader | stage::compute_shader);
  EXPECT_TRUE(with_later(stage::draw_indirect) & stage::compute_shader);
  EXPECT_FALSE(with_later(stage::vertex_shader) & stage::compute_shader);
  EXPECT_EQ(with_earlier(stage::copy), stage::copy);
}

TEST(AccessTable, EveryStageSupportsItsRoles) {
  for (const dsl::Role role :
       {dsl::Role::sampled, dsl::Role::storage, dsl::Role::uniform, dsl::Role::vertex, dsl::Role::index, dsl::Role::indirect, dsl::Role::color,
        dsl::Role::depth, dsl::Role::input, dsl::Role::copy_src, dsl::Role::blit_src, dsl::Role::host_read}) {
    const Effect e = effect(role, dsl::Mode::read, dsl::PassKind::raster);
    for (Stages rest = e.read_stages; rest; rest &= rest - 1)
      EXPECT_EQ(e.reads & ~supported_accesses(rest & ~(rest - 1)), 0u) << static_cast<int>(role);
  }
}

}  // namespace
}  // namespace rg::compiler
