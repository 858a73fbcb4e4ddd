// Draws that the plan records, and the targets they draw to, as calls.
#include "tests/unit/runtime/null_fixture.h"
#include "tests/unit/runtime/plans.h"

namespace rg {
namespace {

class Drawing : public test::NullTest {};

TEST_F(Drawing, BuffersAreBoundAtTheirOffsets) {
  test::TestPlan p;
  p.extents.push_back({"count", 1, {6, 1, 1}, {64, 1, 1}});
  const Index count = p.extent_axis(0);
  const Index vertices = p.buffer("vertices", p.constant(256), 0x80), places = p.buffer("places", p.constant(64), 0x80),
              indices = p.buffer("indices", p.constant(64), 0x40);
  p.vertex_buffers.push_back({{vertices, 0}, kNone});
  p.vertex_buffers.push_back({{places, 0}, p.constant(16)});
  Pass pass;
  pass.name = "draw", pass.kind = PassKind::raster;
  pass.work.kind = WorkKind::draw_indexed, pass.work.x = count, pass.work.y = p.constant(2), pass.work.first = p.constant(3);
  pass.work.vertex_offset = p.constant(-4), pass.work.vertex_buffer_count = 2;
  pass.work.indices = {indices, 0}, pass.work.indices_offset = p.constant(8), pass.work.index_bytes = 2;
  p.pass(pass);
  pass.work.kind = WorkKind::draw, pass.work.indices = {}, pass.work.first_vertex_buffer = 1, pass.work.vertex_buffer_count = 1;
  p.pass(pass);
  GraphInstance graph = make(p);
  const std::string text = frame(graph);
  const auto bound = test::calls(text, "vkCmdBindVertexBuffers");
  ASSERT_EQ(bound.size(), 3u);
  EXPECT_EQ(bound[0], "vkCmdBindVertexBuffers commands2 0 1 buffer1 0");
  EXPECT_EQ(bound[1], "vkCmdBindVertexBuffers commands2 1 1 buffer2 16");
  EXPECT_EQ(bound[2], "vkCmdBindVertexBuffers commands2 0 1 buffer2 16");
  const auto indexed = test::calls(text, "vkCmdBindIndexBuffer");
  ASSERT_EQ(indexed.size(), 1u);
  EXPECT_EQ(indexed[0], "vkCmdBindIndexBuffer commands2 buffer3 8 0");
  EXPECT_EQ(test::calls(text, "vkCmdDrawIndexed ").at(0), "vkCmdDrawIndexed commands2 6 2 3 -4 0");
  EXPECT_EQ(test::calls(text, "vkCmdDraw ").at(0), "vkCmdDraw commands2 6 2 3 0");
}

// A rendering to `layers` layers of `image`.
test::TestPlan one_target(Index (*make)(test::TestPlan&, Index, Index), uint32_t layers, uint32_t view_mask) {
  test::TestPlan p;
  p.extents.push_back({"view", 2, {8, 4, 1}, {64, 64, 1}});
  const Index width = p.extent_axis(0), height = p.extent_axis(1);
  const Index target = make(p, width, height);
  p.barriers({test::discard(target, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment)});
  Pass pass;
  pass.name = "draw", pass.kind = PassKind::raster, pass.work.kind = WorkKind::draw, pass.work.x = p.constant(3);
  pass.rendering = test::one_color_rendering(p, target, width, height, LoadOp::clear, {});
  p.renderings[0].layers = layers, p.renderings[0].view_mask = view_mask;
  p.pass(pass, {test::touches({target, 0}, stage::color_attachment_output, access::color_attachment_write, Layout::color_attachment, true)});
  return p;
}

Index layered_image(test::TestPlan& p, Index width, Index height) {
  const Index image = p.image("eyes", test::kRgba8, width, height, test::kColorAttachment);
  p.resources[image].layers = 3;
  return image;
}
Index volume_image(test::TestPlan& p, Index width, Index height) {
  const Index image = p.image("fog", test::kRgba8, width, height, test::kColorAttachment);
  p.resources[image].dimension = Dimension::d3, p.resources[image].depth = p.constant(8);
  return image;
}

TEST_F(Drawing, ViewsAreLayersOfOneRendering) {
  test::TestPlan p = one_target(layered_image, 3, 7);
  GraphInstance graph = make(p);
  const auto begun = test::calls(frame(graph), "vkCmdBeginRendering");
  ASSERT_EQ(begun.size(), 1u);
  EXPECT_NE(begun[0].find("8x4 layers 3 views 0x7"), std::string::npos) << begun[0];
}

TEST_F(Drawing, APlanNamesTheViewsThatItNeeds) {
  test::TestPlan p = one_target(layered_image, 3, 7);
  const Capability needs[] = {Capability::multiview};
  Plan plan = p.view();
  plan.needs = needs;
  const Result<GraphInstance> refused = GraphInstance::create(device, plan, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
  EXPECT_NE(refused.error().message.find("devices with multiview"), std::string::npos) << refused.error().message;
  NullOptions options;
  options.capabilities = {Capability::multiview};
  Device able = Device::null(nullptr, options);
  const Result<GraphInstance> made = GraphInstance::create(able, plan, {});
  EXPECT_TRUE(made) << made.error().message;
}

TEST_F(Drawing, SlicesOfAVolumeAreLayersOfItsView) {
  test::TestPlan p = one_target(volume_image, 2, 0);
  p.attachments[0].slice = 5, p.attachments[0].slices = 2, p.attachments[0].view_format = Format{41};
  log.clear();
  Result<GraphInstance> graph = GraphInstance::create(device, p.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  const auto views = test::calls(log, "vkCreateImageView");
  ASSERT_EQ(views.size(), 1u);
  EXPECT_NE(views[0].find("type 5 format 41 aspects 1 mips 0+1 layers 5+2"), std::string::npos) << views[0];  // VK_IMAGE_VIEW_TYPE_2D_ARRAY
  const auto images = test::calls(log, "vkCreateImage ");
  ASSERT_EQ(images.size(), 1u);
  EXPECT_NE(images[0].find("flags 0x420"), std::string::npos) << images[0];  // 2D_ARRAY_COMPATIBLE, ALIAS
}

}  // namespace
}  // namespace rg
