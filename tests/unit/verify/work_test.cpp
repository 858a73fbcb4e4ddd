// Transfers, clears and indirect arguments of a plan are those the program declares.
#include <bit>

#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

// A copy of `from` to `to`, planned as declared.
struct Copy {
  Builder b;
  dsl::ResourceId from, to;
  Copy() {
    from = b.buffer("from"), to = b.buffer("to");
    b.buffer("other");
    const auto pass = b.transfer("copy", {reads(from, Role::copy_src), writes(to, Role::copy_dst)});
    b.graph().passes[pass].transfers.push_back({dsl::TransferKind::copy, 0, 1, dsl::Filter::nearest, {}, {}});
    Transfer row;
    row.kind = TransferKind::copy_buffer;
    row.src = {from.value, 0}, row.dst = {to.value, 0};
    b.plan.transfers.push_back(row);
    b.plan.passes[0].work.kind = WorkKind::transfers;
    b.plan.passes[0].work.transfer_count = 1;
  }
  std::string found() {
    std::string text;
    for (const Finding& finding : b.check()) text += finding.text;
    return text;
  }
};

TEST(Work, AsDeclared) { EXPECT_EQ(Copy().found(), ""); }

TEST(Work, OtherResource) {
  Copy copy;
  copy.b.plan.transfers[0].dst.resource = 2;
  EXPECT_EQ(copy.found(), "`copy` and `to`: a transfer of the plan touches another resource than declared");
}

TEST(Work, OtherRange) {
  Copy copy;
  copy.b.plan.transfers[0].src_bytes = {copy.b.constant(0), copy.b.constant(512)};
  EXPECT_EQ(copy.found(), "`copy` and `from`: a transfer of the plan touches another range than declared");
}

TEST(Work, OtherKind) {
  Copy copy;
  copy.b.plan.transfers[0].kind = TransferKind::fill;
  EXPECT_EQ(copy.found(), "`copy` and `to`: a transfer of the plan is of another kind than declared");
}

TEST(Work, Forgotten) {
  Copy copy;
  copy.b.plan.passes[0].work.transfer_count = 0;
  EXPECT_EQ(copy.found(), "`copy`: the plan has other transfers than declared");
}

TEST(Work, ClearValue) {
  for (const float planned : {0.0f, 1.0f}) {
    Builder b;
    const auto x = b.image("x");
    b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
    b.raster("w", {writes(x, Role::color).cleared()});
    b.plan.attachments[0].clear.word[2] = std::bit_cast<uint32_t>(planned);
    const auto findings = b.check();
    ASSERT_EQ(findings.size(), planned == 0.0f ? 0u : 1u);
    if (planned != 0.0f) {
      EXPECT_EQ(findings[0].text, "`w` and `x`: the attachment is cleared to another value than declared");
    }
  }
}

TEST(Work, IndirectArguments) {
  for (const bool other : {false, true}) {
    Builder b;
    const auto arguments = b.buffer("arguments"), elsewhere = b.buffer("elsewhere");
    const auto pass = b.compute("work", {reads(arguments, Role::indirect), reads(elsewhere)});
    b.graph().passes[pass].dispatch.kind = dsl::DispatchKind::indirect;
    b.graph().passes[pass].dispatch.arguments = 0;
    b.plan.passes[0].work.kind = WorkKind::dispatch_indirect;
    b.plan.passes[0].work.arguments.resource = other ? elsewhere.value : arguments.value;
    const auto findings = b.check();
    ASSERT_EQ(findings.size(), other ? 1u : 0u);
    if (other) {
      EXPECT_EQ(findings[0].text, "`work` and `arguments`: the plan takes its indirect arguments from elsewhere");
    }
  }
}

// Three of the four indices of a draw, vertices and indices in buffers of their own.
struct Drawing {
  Builder b;
  dsl::ResourceId vertices, indices;
  Drawing() {
    vertices = b.buffer("vertices"), indices = b.buffer("indices");
    const auto x = b.image("x");
    b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
    const auto pass = b.raster("draw", {writes(x, Role::color).cleared(), reads(vertices, Role::vertex), reads(indices, Role::index)});
    dsl::Draw& draw = b.graph().passes[pass].draw;
    draw.kind = dsl::DrawKind::direct, draw.indexed = true, draw.indices = 2;
    draw.vertices = dsl::ExprId{b.program_constant(3)}, draw.instances = dsl::ExprId{b.program_constant(2)};
    draw.first = dsl::ExprId{b.program_constant(1)}, draw.offset = dsl::ExprId{b.program_constant(7)};
    draw.vertex = {{{}, false, 1}};
    b.plan.vertex_buffers.push_back({{vertices.value, 0}, kNone});
    work().kind = WorkKind::draw_indexed;
    work().x = b.constant(3), work().y = b.constant(2), work().first = b.constant(1), work().vertex_offset = b.constant(7);
    work().vertex_buffer_count = 1;
    work().indices = {indices.value, 0};
  }
  rg::Work& work() { return b.plan.passes[0].work; }
  std::string found() {
    std::string text;
    for (const Finding& finding : b.check()) text += finding.text;
    return text;
  }
};

TEST(Work, DrawsAsDeclared) { EXPECT_EQ(Drawing().found(), ""); }

TEST(Work, DrawsOfOtherVertices) {
  for (Index rg::Work::*const field : {&rg::Work::x, &rg::Work::y, &rg::Work::first, &rg::Work::vertex_offset}) {
    Drawing drawing;
    drawing.work().*field = drawing.b.constant(5);
    EXPECT_EQ(drawing.found(), "`draw`: the plan draws other vertices than declared");
  }
  Drawing plain;
  plain.work().kind = WorkKind::draw;
  EXPECT_EQ(plain.found(), "`draw`: the plan draws in another way than declared");
}

TEST(Work, DrawsFromOtherBuffers) {
  Drawing swapped;
  swapped.b.plan.vertex_buffers[0].ref.resource = swapped.indices.value;
  EXPECT_EQ(swapped.found(), "`draw` and `vertices`: the plan takes its vertices from elsewhere");
  Drawing moved;
  moved.work().indices_offset = moved.b.constant(4);
  EXPECT_EQ(moved.found(), "`draw` and `indices`: the plan takes its indices from elsewhere");
  Drawing unbound;
  unbound.work().vertex_buffer_count = 0;
  EXPECT_EQ(unbound.found(), "`draw`: the plan binds another number of vertex buffers than declared");
}

TEST(Work, TargetsAsDeclared) {
  const auto found = [](auto change) {
    Builder b;
    const auto x = b.image("x");
    b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
    b.raster("w", {writes(x, Role::color).cleared()});
    change(b);
    std::string text;
    for (const Finding& finding : b.check()) text += finding.text;
    return text;
  };
  EXPECT_EQ(found([](Builder&) {}), "");
  EXPECT_EQ(found([](Builder& b) { b.plan.attachments[0].view_format = static_cast<rg::Format>(37); }),
            "`w` and `x`: the attachment is seen otherwise than declared");
  EXPECT_EQ(found([](Builder& b) { b.plan.attachments[0].slices = 1; }), "`w` and `x`: the attachment is seen otherwise than declared");
  EXPECT_EQ(found([](Builder& b) { b.plan.renderings[0].layers = 2; }), "`w`: the rendering has another number of layers than declared");
  EXPECT_EQ(found([](Builder& b) { b.plan.renderings[0].view_mask = 1; }), "`w`: the rendering has other views than declared");
}

}  // namespace
}  // namespace rg::verify
