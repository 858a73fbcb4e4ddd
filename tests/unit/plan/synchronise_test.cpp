// Exact barriers of the classic cases. Every expectation was derived from the rules of the specification, not from the planner.
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

constexpr char kShow[] = "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n";

std::string barriers(const std::string& body, const std::string& resource, const PlanOptions& options = {}) {
  return schedule_text(plan_of(body, options).plan, resource);
}

TEST(Synchronise, ReadAfterWrite) {
  EXPECT_EQ(barriers(std::string("image hdr : rgba16f view\n pass light : compute { write hdr as storage }\n") + kShow, "hdr"),
            "hdr fragment_shader/none -> compute_shader/shader_storage_write  undefined -> general\n"
            "[light]\n"
            "hdr compute_shader/shader_storage_write -> fragment_shader/shader_sampled_read  general -> shader_read_only\n"
            "[show]\n");
}

TEST(Synchronise, ReadersOfOneVersionShareTheBarrierBeforeTheFirst) {
  EXPECT_EQ(barriers("image hdr : rgba16f view\n buffer sum : u32[4]\n"
                     "pass light : raster { color hdr covers }\n"
                     "pass measure : compute { read hdr as sampled  write sum as storage }\n"
                     "pass show : raster { read hdr as sampled in fragment  read sum as storage in fragment  color backbuffer covers }\n",
                     "hdr"),
            "hdr fragment_shader|compute_shader/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
            "[light]\n"
            "hdr color_attachment_output/color_attachment_write -> fragment_shader|compute_shader/shader_sampled_read"
            "  color_attachment -> shader_read_only\n"
            "[measure]\n"
            "[show]\n");
}

TEST(Synchronise, WriteAfterReadOfABufferIsExecutionOnly) {
  EXPECT_EQ(barriers("buffer b : u32[4]\n buffer c : u32[4] output\n"
                     "pass fill : compute { write b as storage }\n"
                     "pass use : compute { read b as uniform  write c as storage }\n"
                     "pass again : compute { write b as storage }\n"
                     "pass show : raster { read b as storage in fragment  color backbuffer covers }\n",
                     "b"),
            "b fragment_shader/none -> compute_shader/none\n"
            "[fill]\n"
            "b compute_shader/shader_storage_write -> compute_shader/uniform_read\n"
            "[use]\n"
            "b compute_shader/none -> compute_shader/none\n"
            "[again]\n"
            "b compute_shader/shader_storage_write -> fragment_shader/shader_storage_read\n"
            "[show]\n");
}

TEST(Synchronise, WriteAfterWriteKeepsTheColourAndOrdersBoth) {
  EXPECT_EQ(
      barriers(std::string("image hdr : rgba16f view\n pass first : raster { color hdr clear 0 }\n pass second : raster { color hdr }\n") + kShow,
               "hdr", {.no_merge = {"second"}}),
      "hdr fragment_shader/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
      "[first]\n"
      "hdr color_attachment_output/color_attachment_write -> color_attachment_output/color_attachment_read|color_attachment_write"
      "  color_attachment -> color_attachment\n"
      "[second]\n"
      "hdr color_attachment_output/color_attachment_write -> fragment_shader/shader_sampled_read  color_attachment -> shader_read_only\n"
      "[show]\n");
}

TEST(Synchronise, ContentsNobodyNeedsAreDiscarded) {
  const std::string body =
      "image hdr : rgba16f view\n buffer sum : u32[4]\n"
      "pass first : raster { color hdr clear 0 }\n"
      "pass measure : compute { read hdr as sampled  write sum as storage }\n"
      "pass second : raster { read sum as storage in fragment  color hdr clear 0 }\n";
  EXPECT_EQ(barriers(body + kShow, "hdr"),
            "hdr fragment_shader/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
            "[first]\n"
            "hdr color_attachment_output/color_attachment_write -> compute_shader/shader_sampled_read  color_attachment -> shader_read_only\n"
            "[measure]\n"
            "hdr compute_shader/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
            "[second]\n"
            "hdr color_attachment_output/color_attachment_write -> fragment_shader/shader_sampled_read  color_attachment -> shader_read_only\n"
            "[show]\n");
  EXPECT_NE(barriers(body + kShow, "hdr", {.discard = false}).find("shader_read_only -> color_attachment\n[second]"), std::string::npos);
}

TEST(Synchronise, MipsAreTrackedOneByOne) {
  EXPECT_EQ(barriers("image hdr : rgba16f view mips 3\n"
                     "pass top : compute { write hdr.mip(0) as storage }\n"
                     "for i in 1..3 { pass down[i] : compute { read hdr.mip(i - 1) as sampled  write target = hdr.mip(i) as storage } }\n"
                     "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n",
                     "hdr"),
            // Acquired as one, all mips at the first use; the last mip had another reader in the frame before.
            "hdr mip 0+2 fragment_shader|compute_shader/none -> compute_shader/shader_storage_write  undefined -> general\n"
            "hdr mip 2+ fragment_shader/none -> compute_shader/shader_storage_write  undefined -> general\n"
            "[top]\n"
            "hdr mip 0+1 compute_shader/shader_storage_write -> fragment_shader|compute_shader/shader_sampled_read  general -> shader_read_only\n"
            "[down[1]]\n"
            "hdr mip 1+1 compute_shader/shader_storage_write -> fragment_shader|compute_shader/shader_sampled_read  general -> shader_read_only\n"
            "[down[2]]\n"
            "hdr mip 2+ compute_shader/shader_storage_write -> fragment_shader/shader_sampled_read  general -> shader_read_only\n"
            "[show]\n");
}

TEST(Synchronise, LayersWrittenApartAreReadTogether) {
  EXPECT_EQ(barriers("image shadow : d32f 64x64 layers 2\n"
                     "pass near : raster { depth shadow.layer(0) clear 1.0 }\n"
                     "pass far : raster { depth shadow.layer(1) clear 1.0 }\n"
                     "pass show : raster { read shadow as sampled in fragment  color backbuffer covers }\n",
                     "shadow"),
            "shadow fragment_shader/none -> early_fragment_tests|late_fragment_tests/depth_stencil_attachment_read|depth_stencil_attachment_write"
            "  undefined -> depth_attachment\n"
            "[near]\n"
            "[far]\n"
            "shadow early_fragment_tests|late_fragment_tests/depth_stencil_attachment_write -> fragment_shader/shader_sampled_read"
            "  depth_attachment -> depth_read_only\n"
            "[show]\n");
}

TEST(Synchronise, DepthIsTestedAndSampledAtOnce) {
  const FramePlan frame = plan_of(
      "image depth : d32f view\n"
      "pass prepass : raster { depth depth clear 0.0 }\n"
      "pass fog : raster { depth depth readonly  read scene_depth = depth as sampled in fragment  color backbuffer covers }\n");
  EXPECT_EQ(schedule_text(frame.plan, "depth"),
            // Late tests come after the fragment shader: waiting for them waits for both.
            "depth late_fragment_tests/none -> "
            "early_fragment_tests|late_fragment_tests/depth_stencil_attachment_read|depth_stencil_attachment_write  undefined -> depth_attachment\n"
            "[prepass]\n"
            "depth early_fragment_tests|late_fragment_tests/depth_stencil_attachment_write -> "
            "fragment_shader|early_fragment_tests|late_fragment_tests/depth_stencil_attachment_read|shader_sampled_read"
            "  depth_attachment -> depth_read_only\n"
            "[fog]\n");
  const Attachment& attachment = attachment_of(frame.plan, "fog", "depth");
  EXPECT_EQ(attachment.layout, Layout::depth_read_only);
  EXPECT_EQ(attachment.load, LoadOp::load);
  EXPECT_EQ(attachment.store, StoreOp::none);
}

const Boundary& boundary_of(const std::vector<Boundary>& rows, Index resource, uint32_t age) {
  for (const Boundary& row : rows)
    if (row.ref.resource == resource && row.ref.age == age) return row;
  ADD_FAILURE() << "no state of age " << age;
  return rows.front();
}

TEST(Synchronise, HistoryPassesItsStateFromAgeToAge) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view history 1 init clear 0\n"
      "pass accumulate : compute { read hdr.prev(1) as sampled  write hdr as storage }\n"
      "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n");
  // The copy read as history was last transitioned for the fragment shader of the frame before: one barrier serves both reads.
  EXPECT_EQ(schedule_text(frame.plan, "hdr"),
            "hdr fragment_shader|compute_shader/none -> compute_shader/shader_storage_write  undefined -> general\n"
            "[accumulate]\n"
            "hdr compute_shader/shader_storage_write -> fragment_shader|compute_shader/shader_sampled_read  general -> shader_read_only\n"
            "[show]\n");
  const Index hdr = resource_named(frame.plan, "hdr");
  // The oldest copy becomes the current one; its contents are dead.
  const Boundary &now = boundary_of(frame.plan.entry, hdr, 0), &before = boundary_of(frame.plan.entry, hdr, 1),
                 &left = boundary_of(frame.plan.exit, hdr, 0);
  EXPECT_TRUE(now.discard);
  EXPECT_EQ(now.layout, Layout::undefined);
  EXPECT_FALSE(before.discard);
  EXPECT_EQ(before.layout, Layout::shader_read_only);
  EXPECT_EQ(before.stages, stage::fragment_shader | stage::compute_shader);
  EXPECT_EQ(left.layout, before.layout);
  EXPECT_EQ(left.stages, before.stages);
  EXPECT_TRUE(boundary_of(frame.plan.exit, hdr, 1).discard);
}

TEST(Synchronise, ImportedBuffersArriveVisibleAndStay) {
  const FramePlan frame =
      plan_of(program_of_text("module test\nextent view = runtime(64, 64) max(64, 64)\n"
                              "interface Scene { lights: buffer u32[64] ready as storage in compute }\n"
                              "graph frame(scene: Scene, surface backbuffer: rgba8 view after copy_src) {\n"
                              "image hdr : rgba16f view\n"
                              "pass light : compute { read scene.lights as storage  write hdr as storage }\n"
                              "pass show : raster { read hdr as sampled in fragment  color backbuffer covers }\n}\n"));
  EXPECT_EQ(schedule_text(frame.plan, "scene.lights"), "[light]\n[show]\n");
  EXPECT_EQ(frame.plan.resources[resource_named(frame.plan, "scene.lights")].import_slot, 0u);
}

TEST(Synchronise, SurfaceIsDiscardedAndLeftAsDeclared) {
  EXPECT_EQ(barriers("pass draw : raster { color backbuffer clear 0 }\n", "backbuffer"),
            "backbuffer copy/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
            "[draw]\n"
            "backbuffer color_attachment_output/color_attachment_write -> copy/transfer_read  color_attachment -> transfer_src\n");
}

TEST(Synchronise, ReadBackEndsAtTheHost) {
  EXPECT_EQ(barriers("buffer counts : u32[4] readback\n pass count : compute { write counts as storage }\n", "counts"),
            "[count]\n"
            "counts compute_shader/shader_storage_write -> host/host_read\n");
}

TEST(Synchronise, AtomicsOfOneGroupNeedNothingBetweenThem) {
  EXPECT_EQ(barriers("buffer bits : u32[4]\n"
                     "pass zero : transfer { fill bits 0 }\n"
                     "pass a : compute { atomic bits as storage }\n"
                     "pass b : compute { atomic bits as storage }\n"
                     "pass show : raster { read bits as storage in fragment  color backbuffer covers }\n",
                     "bits"),
            "bits fragment_shader/none -> clear/none\n"
            "[zero]\n"
            "bits clear/transfer_write -> compute_shader/shader_storage_read|shader_storage_write\n"
            "[a]\n"
            "[b]\n"
            "bits compute_shader/shader_storage_write -> fragment_shader/shader_storage_read\n"
            "[show]\n");
}

TEST(Synchronise, PassesThatMayBeSkippedKeepWhatWasThere) {
  // `patch` covers its target, but a frame without it must show what `base` drew.
  EXPECT_EQ(barriers("image hdr : rgba16f view\n"
                     "pass base : raster { color hdr clear 0 }\n"
                     "if host sometimes { pass patch : compute { write hdr as storage } }\n" +
                         std::string(kShow),
                     "hdr"),
            "hdr fragment_shader/none -> color_attachment_output/color_attachment_write  undefined -> color_attachment\n"
            "[base]\n"
            "hdr color_attachment_output/color_attachment_write -> compute_shader/shader_storage_write  color_attachment -> general\n"
            "[patch]\n"
            "hdr compute_shader/shader_storage_write -> fragment_shader/shader_sampled_read  general -> shader_read_only\n"
            "[show]\n");
}

TEST(Synchronise, BytesOfABufferAreTrackedApart) {
  EXPECT_EQ(barriers("buffer b : u32[64]\n"
                     "pass low : compute { write b.bytes(0, 128) as storage }\n"
                     "pass high : compute { read low = b.bytes(0, 128) as storage  write high = b.bytes(128, 128) as storage }\n"
                     "pass show : raster { read b.bytes(128, 128) as storage in fragment  color backbuffer covers }\n",
                     "b"),
            "b bytes 0+128 compute_shader/none -> compute_shader/none\n"
            "b bytes 128+ fragment_shader/none -> compute_shader/none\n"
            "[low]\n"
            "b bytes 0+128 compute_shader/shader_storage_write -> compute_shader/shader_storage_read\n"
            "[high]\n"
            "b bytes 128+ compute_shader/shader_storage_write -> fragment_shader/shader_storage_read\n"
            "[show]\n");
}

TEST(Synchronise, NothingBluntAnywhere) {
  const FramePlan frame = plan_of(
      "image hdr : rgba16f view\n image depth : d32f view\n buffer counts : u32[4] readback\n"
      "pass draw : raster { color hdr clear 0  depth depth clear 0.0 }\n"
      "pass count : compute { read hdr as sampled  read depth as sampled  write counts as storage }\n" +
      std::string(kShow));
  constexpr Stages kBluntStages = stage::all_commands | stage::all_graphics;
  constexpr Accesses kBluntAccesses = access::memory_read | access::memory_write;
  EXPECT_FALSE(frame.plan.image_barriers.empty());
  for (const ImageBarrier& b : frame.plan.image_barriers) {
    EXPECT_EQ((b.src_stages | b.dst_stages) & kBluntStages, 0u);
    EXPECT_EQ((b.src_accesses | b.dst_accesses) & kBluntAccesses, 0u);
  }
}

// Parts of a buffer join where they lie side by side, and only there.
// Reads of `whole` in three groups; `middle` is what touches its middle third, `between` runs before the last of them.
FramePlan thirds_of(const std::string& middle, const std::string& between = {}) {
  return plan_of(
      "buffer whole : u32[192]\n buffer first : u32[64]\n buffer last : u32[64]\n buffer middle : u32[64] output\n"
      "pass fill : compute { write whole as storage }\n"
      "pass read_first : compute { read whole.bytes(0, 256) as storage  write first as storage }\n"
      "pass read_last : compute { read whole.bytes(512, 256) as storage  read first as storage  write last as storage }\n" +
      between + "pass read_middle : compute { " + middle +
      "  read last as storage  write middle as storage }\n"
      "pass show : raster { color backbuffer covers }\n");
}
std::vector<const BufferBarrier*> reads_of_whole(const FramePlan& frame) {
  std::vector<const BufferBarrier*> rows;
  for (const BufferBarrier& b : frame.plan.buffer_barriers)
    if (b.buffer.resource == resource_named(frame.plan, "whole") && (b.dst_accesses & access::shader_storage_read) != 0) rows.push_back(&b);
  return rows;
}

// The first group waits for the writer anyway: what later readers need of it is made visible there, in one barrier where the parts are neighbours.
TEST(Synchronise, PartsOfABufferAreGatheredInOneGroup) {
  const FramePlan frame = thirds_of("read whole.bytes(256, 256) as storage");
  EXPECT_EQ(order_text(frame.plan), "| fill | read_first | read_last | read_middle show | ");
  EXPECT_EQ(reads_of_whole(frame).size(), 1u);
  EXPECT_EQ(frame.unproved, 0u);
}

TEST(Synchronise, PartsThatAreApartKeepABarrierEach) {
  const FramePlan frame = thirds_of("read first as storage");
  EXPECT_EQ(reads_of_whole(frame).size(), 2u);  // in the first group both: 0 to 256 and 512 to the end
  EXPECT_EQ(frame.unproved, 0u);
}

TEST(Synchronise, PartsWrittenInBetweenAreNotGathered) {
  const FramePlan frame =
      thirds_of("read whole.bytes(256, 256) as storage", "pass again : compute { read first as storage  update whole.bytes(256, 256) as storage }\n");
  EXPECT_EQ(reads_of_whole(frame).size(), 4u);  // 0 to 256, 512 to the end, the middle for `again`, and once more for its reader
  EXPECT_EQ(frame.unproved, 0u);
}

// ---- ranges that depend on extents --------------------------------------------------------------------------------

FramePlan parts_of(const std::string& passes) {
  return plan_of(
      program_of_text("module test\nextent n = runtime(64) min(20) max(1000)\n extent m = runtime(8) max(16)\n"
                      "graph frame() {\n buffer words : u32[n]\n buffer all : u32[n] output\n" +
                      passes + "}\n"));
}
const std::string kLeft = "pass left : compute { write words.bytes(0, n / 2 * 4) as storage }\n";

TEST(Synchronise, PiecesCutByExtentsAreKeptApart) {
  const FramePlan frame = parts_of(
      "pass right : compute { write words.bytes(n / 2 * 4, (n - n / 2) * 4) as storage }\n"
      "pass again : compute { read words.bytes(n / 2 * 4, (n - n / 2) * 4) as storage  write all as storage }\n"
      "pass left  : compute { write words.bytes(0, n / 2 * 4) as storage  after again }\n"
      "pass more  : compute { read words as storage  update all as storage }\n");
  EXPECT_EQ(order_text(frame.plan), "| right | again left | more ");
  const std::vector<int64_t> extents = {41, 1, 1, 8, 1, 1};
  std::vector<std::pair<int64_t, int64_t>> bytes;
  for (const BufferBarrier& barrier : frame.plan.buffer_barriers)
    if (barrier.buffer.resource == resource_named(frame.plan, "words") && barrier.src_accesses != 0)
      bytes.emplace_back(barrier.bytes.offset == kNone ? 0 : evaluate(frame.plan.exprs, barrier.bytes.offset, extents),
                         barrier.bytes.size == kNone ? -1 : evaluate(frame.plan.exprs, barrier.bytes.size, extents));
  EXPECT_EQ(bytes, (std::vector<std::pair<int64_t, int64_t>>{{80, -1}, {0, 80}}));
}

TEST(Synchronise, PiecesOfUnknownOrderMayOverlap) {
  const FramePlan frame = parts_of(kLeft +
                                   "pass right : compute { write words.bytes(m * 4, 4) as storage }\n"
                                   "pass more  : compute { read words.bytes(0, n / 2 * 4) as storage  write all as storage }\n");
  EXPECT_EQ(order_text(frame.plan), "| left | right | more ");
}

}  // namespace
}  // namespace rg::compiler
