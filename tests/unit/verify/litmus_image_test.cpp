// Litmus cases on images: subresources, layouts, renderings.
#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

constexpr auto kTests = stage::early_fragment_tests | stage::late_fragment_tests;
constexpr auto kDepthWrite = access::depth_stencil_attachment_write, kDepthRead = access::depth_stencil_attachment_read;

// One rendering only tests; the next one tests, and then draws. `ordered`: stages of the second for which it waits.
void test_then_draw(Builder& b, Stages ordered) {
  const auto x = b.image("x", Format::d32f);
  const Do tests = reads(x, Role::depth_readonly).in(Layout::depth_attachment);
  b.start(x, Layout::depth_attachment, kTests, kDepthRead | kDepthWrite);
  b.raster("clear", {writes(x, Role::depth).cleared()});
  b.memory(kTests, kDepthWrite, kTests, kDepthRead | kDepthWrite);
  b.raster("test", {tests.with(LoadOp::load, StoreOp::none)});
  b.memory(kTests, 0, ordered, 0);
  b.raster("test again", {tests});
  b.raster("draw", {updates(x, Role::depth)});
  b.merge_rendering();
}

const Litmus kImageCases[] = {
    {"SampleAfterStorageWrite",
     "Layout transition inside the memory dependency",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::general, Layout::shader_read_only, st::compute_shader, ac::shader_storage_write, st::fragment_shader,
                       ac::shader_sampled_read);
       b.raster("r", {reads(x, Role::sampled, kFs)});
     }},
    {"DisjointMips",
     "Subresources are separate memory",
     {},
     [](Builder& b) {
       const auto x = b.image("x", Format::rgba16f, 2);
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w0", {writes(x).mip(0)});
       b.compute("w1", {writes(x).mip(1)});
     }},
    {"MipChain",
     "Subresources are tracked one by one",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x", Format::rgba16f, 3);
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w0", {writes(x).mip(0)});
       b.image_barrier(x, Layout::general, Layout::general, st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read,
                       {aspect_color, 1, 1, 0, 1});
       b.compute("w1", {reads(x).mip(0), writes(x).mip(1)});
     }},
    {"DisjointLayers",
     "Array layers are separate subresources",
     {},
     [](Builder& b) {
       const auto x = b.image("x", Format::rgba16f, 1, 2);
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w0", {writes(x).layer(0)});
       b.compute("w1", {writes(x).layer(1)});
     }},
    {"VolumeReadAfterWrite",
     "An image's slices are one subresource",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.source(x).dimension = dsl::Dimension::d3;
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.compute("r", {reads(x)});
     }},
    {"UsedWhileUndefined",
     "VUID-vkCmdDraw-None-09600: descriptors name the layout the image is in",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.compute("w", {writes(x)});
     }},
    {"DescriptorLayout",
     "VUID-vkCmdDraw-None-09600: descriptors name the layout the image is in",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"WrongOldLayout",
     "VUID-VkImageMemoryBarrier2-oldLayout-01197: the old layout is the current one or undefined",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::transfer_dst, Layout::shader_read_only, st::compute_shader, ac::shader_storage_write, st::compute_shader,
                       ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"StorageNeedsGeneral",
     "Storage images are accessed in GENERAL",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::shader_read_only, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x).in(Layout::shader_read_only)});
     }},
    {"TransitionAfterWriteUnavailable",
     "A layout transition writes: earlier writes are made available first",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::general, Layout::shader_read_only, st::compute_shader, 0, st::compute_shader, ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"TransitionRacesReader",
     "A layout transition writes: earlier reads come first",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::transfer_dst, st::copy, ac::transfer_write);
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.image_barrier(x, Layout::transfer_dst, Layout::shader_read_only, st::copy, ac::transfer_write, st::fragment_shader, ac::shader_sampled_read);
       b.raster("r", {reads(x, Role::sampled, kFs)});
       b.image_barrier(x, Layout::shader_read_only, Layout::transfer_src, st::copy, ac::transfer_write, st::copy, ac::transfer_read);
       b.transfer("out", {reads(x, Role::copy_src)});
     }},
    {"TransitionVisibleToDestinationOnly",
     "The transition's write is visible to the second access scope only",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::transfer_dst, st::copy, ac::transfer_write);
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.image_barrier(x, Layout::transfer_dst, Layout::shader_read_only, st::copy, ac::transfer_write, st::fragment_shader, ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"DiscardLosesContents",
     "From UNDEFINED, contents may be discarded",
     {"poison read"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::undefined, Layout::shader_read_only, st::compute_shader, ac::shader_storage_write, st::compute_shader,
                       ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"NewLayoutUndefined",
     "VUID-VkImageMemoryBarrier2-newLayout-01198",
     {"invalid barrier", "wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.image_barrier(x, Layout::general, Layout::undefined, st::compute_shader, ac::shader_storage_write, st::compute_shader,
                       ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"RangeOutsideImage",
     "VUID-VkImageMemoryBarrier2-subresourceRange-01724",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = b.image("x", Format::rgba16f, 2);
       b.image_barrier(x, Layout::undefined, Layout::general, 0, 0, st::compute_shader, ac::shader_storage_write, {aspect_color, 0, 3, 0, 1});
       b.compute("w", {writes(x)});
     }},
    {"LayoutNeedsUsage",
     "VUID-VkImageMemoryBarrier2-oldLayout-01212: TRANSFER_DST layout needs TRANSFER_DST usage",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.planned(x).usage = 0x4;
       b.lifetime(x, dsl::Lifetime::transient);
       Boundary last;
       last.stages = st::copy, last.accesses = ac::transfer_write, last.discard = true;
       b.boundary(x, last, last);
       b.image_barrier(x, Layout::undefined, Layout::transfer_dst, st::copy, ac::transfer_write, st::copy, ac::transfer_write);
       b.transfer("w", {writes(x, Role::copy_dst)});
     }},
    {"TwoTransitionsInOneCommand",
     "Barriers of one command are unordered: a range may be named once",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.image_barrier(x, Layout::undefined, Layout::general, 0, 0, st::compute_shader, ac::shader_storage_write, {}, true);
       b.compute("w", {writes(x)});
     }},
    {"CombinedLayoutMeansBothAspects",
     "DEPTH_STENCIL_ATTACHMENT_OPTIMAL is DEPTH_ATTACHMENT and STENCIL_ATTACHMENT",
     {},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f_s8);
       b.start(x, Layout::depth_stencil_attachment, kTests, kDepthWrite | kDepthRead);
       b.raster("w", {writes(x, Role::depth).cleared(), writes(x, Role::stencil).cleared()});
     }},
    {"AspectsApart",
     "Aspects are separate subresources",
     {"read-after-write", "wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f_s8);
       b.start(x, Layout::depth_stencil_attachment, kTests, kDepthWrite | kDepthRead);
       b.raster("w", {writes(x, Role::depth).cleared(), writes(x, Role::stencil).cleared()});
       b.image_barrier(x, Layout::depth_stencil_attachment, Layout::depth_stencil_read_only, kTests, kDepthWrite, st::fragment_shader | kTests,
                       ac::shader_sampled_read | kDepthRead, {aspect_depth, 0, 1, 0, 1});
       Do stencil = reads(x, Role::sampled, kFs).in(Layout::stencil_read_only);
       stencil.range.aspects = aspect_stencil;
       b.raster("r", {reads(x, Role::sampled, kFs)});
       b.plan.accesses.push_back(
           {{x.value, 0}, {aspect_stencil, 0, 1, 0, 1}, {}, st::fragment_shader, ac::shader_sampled_read, Layout::stencil_read_only, false});
       b.plan.passes.back().access_count = 2;
       b.graph().passes.rows.back().accesses.push_back(
           {x, stencil.range, 0, dsl::Mode::read, Role::sampled, kFs, {}, "stencil", {}, {}, false, false, {}});
     }},

    // ---- renderings ----
    {"SampleAfterRendering",
     "Attachment writes are COLOR_ATTACHMENT_WRITE in COLOR_ATTACHMENT_OUTPUT",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared()});
       b.image_barrier(x, Layout::color_attachment, Layout::shader_read_only, st::color_attachment_output, ac::color_attachment_write,
                       st::fragment_shader, ac::shader_sampled_read);
       b.raster("r", {reads(x, Role::sampled, kFs)});
     }},
    {"SampleAfterRenderingBare",
     "Dynamic rendering ends without any implicit dependency",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).in(Layout::general).cleared()});
       b.raster("r", {reads(x, Role::sampled, kFs).in(Layout::general)});
     }},
    {"TransitionAfterRenderingBadSource",
     "The transition waits for the attachment writes",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared()});
       b.image_barrier(x, Layout::color_attachment, Layout::shader_read_only, st::fragment_shader, ac::shader_storage_write, st::fragment_shader,
                       ac::shader_sampled_read);
       b.raster("r", {reads(x, Role::sampled, kFs)});
     }},
    {"ConsecutiveRenderingsClear",
     "CLEAR writes: two renderings into one attachment are not ordered by themselves",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.raster("w2", {writes(x, Role::color).cleared()});
     }},
    {"ConsecutiveRenderingsLoad",
     "LOAD reads: two renderings into one attachment are not ordered by themselves",
     {"read-after-write", "write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.raster("w2", {updates(x, Role::color)});
     }},
    {"ConsecutiveRenderingsOrdered",
     "LOAD is COLOR_ATTACHMENT_READ, the rest COLOR_ATTACHMENT_WRITE",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.memory(st::color_attachment_output, ac::color_attachment_write, st::color_attachment_output,
                ac::color_attachment_read | ac::color_attachment_write);
       b.raster("w2", {updates(x, Role::color)});
     }},
    {"LoadNeedsRead",
     "LOAD_OP_LOAD is COLOR_ATTACHMENT_READ",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.memory(st::color_attachment_output, ac::color_attachment_write, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w2", {updates(x, Role::color)});
     }},
    {"OneRendering",
     "Draws of one rendering follow rasterization order",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.raster("w2", {updates(x, Role::color)});
       b.merge_rendering();
     }},
    {"TestBeforeADrawOfTheSameRendering",
     "A draw comes after tests of the rendering before, also where a pass of its own has tested in between",
     {},
     [](Builder& b) { test_then_draw(b, kTests); }},
    {"TestThatHidesAnotherFromADrawOfTheSameRendering",
     "As above; rasterization order, which the draw keeps with the test of its own rendering, leads to no rendering before",
     {"write-after-read"},
     [](Builder& b) { test_then_draw(b, st::late_fragment_tests); }},
    {"LoadAfterComputeWrite",
     "LOAD_OP_LOAD reads what compute wrote",
     {"read-after-write", "write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
       b.raster("r", {updates(x, Role::color).in(Layout::general)});
     }},
    {"AttachmentLayout",
     "VUID-vkCmdBeginRendering-pRenderingInfo-09588: the attachment is in the layout named",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared()});
     }},
    {"AttachmentLayoutKind",
     "VUID-VkRenderingInfo-colorAttachmentCount-06091: not a transfer layout",
     {"wrong layout"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::transfer_dst, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).in(Layout::transfer_dst).cleared()});
     }},
    {"FeedbackLoop",
     "Sampling an attachment that is written is a feedback loop",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::general, st::color_attachment_output | st::fragment_shader, ac::color_attachment_write | ac::shader_sampled_read);
       b.raster("w", {writes(x, Role::color).in(Layout::general).cleared(), reads(x, Role::sampled, kFs).in(Layout::general)});
     }},
    {"DepthTestedAndSampled",
     "Reads in a read-only layout do not conflict",
     {},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f);
       b.start(x, Layout::depth_attachment, kTests, kDepthWrite);
       b.raster("w", {writes(x, Role::depth).cleared()});
       b.image_barrier(x, Layout::depth_attachment, Layout::depth_read_only, kTests, kDepthWrite, kTests | st::fragment_shader,
                       kDepthRead | ac::shader_sampled_read);
       b.raster("r", {reads(x, Role::depth_readonly).with(LoadOp::load, StoreOp::none), reads(x, Role::sampled, kFs)});
     }},
    {"ReadOnlyDepthStore",
     "STORE_OP_STORE writes, also where nothing was written",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f);
       b.start(x, Layout::depth_attachment, kTests, kDepthWrite);
       b.raster("w", {writes(x, Role::depth).cleared()});
       b.image_barrier(x, Layout::depth_attachment, Layout::depth_read_only, kTests, kDepthWrite, kTests | st::compute_shader,
                       kDepthRead | kDepthWrite | ac::shader_sampled_read);
       b.compute("sample", {reads(x, Role::sampled)});
       b.raster("test", {reads(x, Role::depth_readonly)});
     }},
    {"ReadOnlyDepthNoStore",
     "STORE_OP_NONE does not access the attachment",
     {},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f);
       b.start(x, Layout::depth_attachment, kTests, kDepthWrite);
       b.raster("w", {writes(x, Role::depth).cleared()});
       b.image_barrier(x, Layout::depth_attachment, Layout::depth_read_only, kTests, kDepthWrite, kTests | st::compute_shader,
                       kDepthRead | ac::shader_sampled_read);
       b.compute("sample", {reads(x, Role::sampled)});
       b.raster("test", {reads(x, Role::depth_readonly).with(LoadOp::load, StoreOp::none)});
     }},
    {"DepthLoadsEarly",
     "Depth LOAD is in EARLY_FRAGMENT_TESTS",
     {"read-after-write", "write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f);
       b.start(x, Layout::depth_attachment, kTests, kDepthWrite);
       b.raster("w1", {writes(x, Role::depth).cleared()});
       b.memory(kTests, kDepthWrite, st::late_fragment_tests, kDepthRead | kDepthWrite);
       b.raster("w2", {updates(x, Role::depth)});
     }},
    {"DepthStoresLate",
     "Depth writes and STORE are in LATE_FRAGMENT_TESTS too",
     {"read-after-write", "write-after-write"},
     [](Builder& b) {
       const auto x = b.image("x", Format::d32f);
       b.start(x, Layout::depth_attachment, kTests, kDepthWrite);
       b.raster("w1", {writes(x, Role::depth).cleared()});
       b.memory(st::early_fragment_tests, kDepthWrite, kTests, kDepthRead | kDepthWrite);
       b.raster("w2", {updates(x, Role::depth)});
     }},
    {"LoadOfNothing",
     "LOAD of undefined contents",
     {"lost contents"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write | ac::color_attachment_read);
       b.raster("w", {updates(x, Role::color)});
     }},
    {"StoreDropped",
     "STORE_OP_DONT_CARE leaves undefined contents",
     {"poison read"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared().with(LoadOp::clear, StoreOp::dont_care)});
       b.image_barrier(x, Layout::color_attachment, Layout::shader_read_only, st::color_attachment_output, ac::color_attachment_write,
                       st::compute_shader, ac::shader_sampled_read);
       b.compute("r", {reads(x, Role::sampled)});
     }},
    {"LoadDropped",
     "LOAD_OP_DONT_CARE leaves undefined contents",
     {"poison read"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w1", {writes(x, Role::color).cleared()});
       b.memory(st::color_attachment_output, ac::color_attachment_write, st::color_attachment_output,
                ac::color_attachment_read | ac::color_attachment_write);
       b.raster("w2", {updates(x, Role::color).with(LoadOp::dont_care)});
     }},
    {"ClearForgotten",
     "A declared clear is LOAD_OP_CLEAR",
     {"lost contents"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared().with(LoadOp::dont_care)});
     }},
    {"ResolveIsColorOutput",
     "Resolves of a rendering are COLOR_ATTACHMENT_OUTPUT accesses",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.image("x"), y = b.image("y");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.start(y, Layout::general, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared(), reads(x, Role::resolve_src), writes(y, Role::resolve_dst).in(Layout::general)});
       b.memory(st::resolve, ac::transfer_write, st::compute_shader, ac::shader_sampled_read);
       b.compute("r", {reads(y, Role::sampled).in(Layout::general)});
     }},
    {"ResolveOrdered",
     "Resolves of a rendering are COLOR_ATTACHMENT_OUTPUT accesses",
     {},
     [](Builder& b) {
       const auto x = b.image("x"), y = b.image("y");
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.start(y, Layout::general, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared(), reads(x, Role::resolve_src), writes(y, Role::resolve_dst).in(Layout::general)});
       b.memory(st::color_attachment_output, ac::color_attachment_write, st::compute_shader, ac::shader_sampled_read);
       b.compute("r", {reads(y, Role::sampled).in(Layout::general)});
     }},
    {"ReadAfterFragmentStore",
     "Fragment shader storage writes of one pass and reads of the next",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.raster("w", {writes(x, Role::storage, kFs)});
       b.raster("r", {reads(x, Role::storage, kFs)});
     }},
};

class ImageLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(ImageLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, ImageLitmus, ::testing::ValuesIn(kImageCases), litmus_name);

}  // namespace
}  // namespace rg::verify
