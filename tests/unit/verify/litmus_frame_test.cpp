// Litmus cases on what frames mean: versions, conditions, boundaries, shared memory.
#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

constexpr Stages kCs = stage::compute_shader;
constexpr Accesses kRead = access::shader_storage_read, kWrite = access::shader_storage_write;

Boundary state(Stages stages, Accesses accesses, Layout layout = Layout::undefined, bool discard = false) {
  Boundary row;
  row.stages = stages, row.accesses = accesses, row.layout = layout, row.discard = discard;
  return row;
}

dsl::ResourceId output(Builder& b, const std::string& name) {
  const auto id = b.buffer(name);
  b.source(id).is_output = true;
  return id;
}

void barrier(Builder& b, Accesses to = kRead) { b.memory(kCs, kWrite, kCs, to); }

// A transient whose memory is handed on: the group it is acquired in, and the point before which its last users stand.
void hand_over(Builder& b, dsl::ResourceId id, Index group, Stages stages, Accesses accesses, Index point, Stages last, Accesses unavailable) {
  const auto clocks = static_cast<Index>(b.plan.alias_clocks.size());
  b.plan.acquires.push_back({id.value, group, kNone, 0, stages, accesses, 0, group, clocks});
  b.plan.releases.push_back({id.value, last, unavailable, 0, point});
  b.plan.alias_clocks.insert(b.plan.alias_clocks.end(), {group, static_cast<Index>(b.plan.groups.size())});
}

// a (written, read), then c (written, read) in the same memory.
struct Pair {
  dsl::ResourceId a, c;
};
Pair aliased_pair(Builder& b) {
  const auto a = b.buffer("a"), c = b.buffer("c");
  for (const auto id : {a, c}) {
    b.lifetime(id, dsl::Lifetime::transient);
    b.boundary(id, state(kCs, 0, Layout::undefined, true), state(kCs, 0, Layout::undefined, true));
    b.planned(id).estimated_bytes = 1024;
  }
  const auto out = output(b, "out");
  b.memory(kCs, 0, kCs, 0);
  b.compute("wa", {writes(a)});
  barrier(b);
  b.compute("ra", {reads(a), writes(out)});
  b.memory(kCs, kWrite, kCs, kRead | kWrite);
  b.compute("wc", {writes(c)});
  barrier(b);
  b.compute("rc", {reads(c), updates(out)});
  hand_over(b, a, 0, kCs, kWrite, 2, kCs, 0);
  hand_over(b, c, 2, kCs, kWrite, 4, kCs, 0);
  return {a, c};
}

void history(Builder& b, dsl::ResourceId id, const Boundary& state_of_all) {
  b.lifetime(id, dsl::Lifetime::history, 1);
  Boundary older = state_of_all;
  older.ref.age = 1;
  b.boundary(id, state_of_all, state_of_all);
  b.boundary(id, older, older);
}

const Litmus kFrameCases[] = {
    // ---- versions ----
    {"PassesSwapped",
     "A read sees the version that program order gives it",
     {"write-after-write", "wrong version"},
     [](Builder& b) {
       const auto x = b.buffer("x"), out = output(b, "out");
       b.compute("w1", {writes(x)});
       barrier(b);
       b.compute("r", {reads(x), writes(out)});
       b.memory(kCs, kWrite, kCs, kRead | kWrite);
       b.compute("w2", {writes(x)});
       std::swap(b.plan.steps[2], b.plan.steps[4]);
     }},
    {"OutputNotWritten",
     "Outputs hold at the end of the frame what program order gives",
     {"lost contents"},
     [](Builder& b) {
       const auto out = output(b, "out");
       b.compute("w", {writes(out)});
       b.plan.steps.clear(), b.plan.passes.clear(), b.plan.program_pass.clear();
     }},
    {"DeadPassDropped",
     "What no output depends on may be dropped",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.plan.steps.clear(), b.plan.passes.clear(), b.plan.program_pass.clear();
     }},
    {"ProducerDropped",
     "Every read finds the version that reaches it",
     {"poison read"},
     [](Builder& b) {
       const auto x = b.buffer("x"), out = output(b, "out");
       b.compute("w", {writes(x)});
       b.compute("r", {reads(x), writes(out)});
       b.plan.steps.erase(b.plan.steps.begin());
       b.plan.steps[0].index = 0;
       b.plan.passes.erase(b.plan.passes.begin());
       b.plan.program_pass = {1};
     }},
    {"KeptPassDropped",
     "`keep`: never dropped",
     {"missing pass"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.graph().passes.rows[0].keep = true;
       b.plan.steps.clear(), b.plan.passes.clear(), b.plan.program_pass.clear();
     }},
    {"DeclaredOrder",
     "`after` is kept",
     {"order"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       const auto first = b.compute("first", {writes(x)});
       const auto second = b.compute("second", {writes(y)});
       b.graph().passes[first].after.push_back(second);
     }},
    {"AtomicsInAnyOrder",
     "Commuting operations give one result in any order",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), out = output(b, "out");
       b.transfer("clear", {writes(x, Role::fill_dst)});
       b.memory(st::clear, ac::transfer_write, kCs, kRead | kWrite);
       b.compute("a1", {counts(x)});
       b.compute("a2", {counts(x)});
       barrier(b);
       b.compute("r", {reads(x), writes(out)});
       std::swap(b.plan.steps[2], b.plan.steps[3]);
     }},

    // ---- conditions ----
    {"SkippedWriterKeepsContents",
     "A skipped pass is the identity; its barriers run",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), out = output(b, "out");
       b.compute("w1", {writes(x)});
       b.memory(kCs, kWrite, kCs, kWrite);
       b.condition(b.compute("w2", {writes(x)}), "sometimes");
       barrier(b);
       b.compute("r", {reads(x), writes(out)});
     }},
    {"SkippedWriterDiscards",
     "A barrier that discards runs also where the pass is skipped",
     {"poison read"},
     [](Builder& b) {
       const auto x = b.image("x");
       const auto out = output(b, "out");
       b.start(x, Layout::general, kCs, kWrite);
       b.compute("w1", {writes(x)});
       b.image_barrier(x, Layout::undefined, Layout::general, kCs, kWrite, kCs, kWrite);
       b.condition(b.compute("w2", {writes(x)}), "sometimes");
       b.image_barrier(x, Layout::general, Layout::general, kCs, kWrite, kCs, kRead);
       b.compute("r", {reads(x), writes(out)});
     }},
    {"GuardForgotten",
     "A pass runs under the conditions declared, and no others",
     {"invalid plan"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.condition(b.compute("w", {writes(x)}), "sometimes");
       b.plan.passes[0].guard = 0;
     }},

    // ---- from frame to frame ----
    {"TransientOverFrames",
     "The frame before used the same memory: write-after-read across frames",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::transient);
       b.boundary(x, state(kCs, 0, Layout::undefined, true), state(kCs, 0, Layout::undefined, true));
       b.compute("w", {writes(x)});
       barrier(b);
       b.compute("r", {reads(x)});
     }},
    {"TransientOverFramesOrdered",
     "An execution dependency orders a write after the reads of the frame before",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::transient);
       b.boundary(x, state(kCs, 0, Layout::undefined, true), state(kCs, 0, Layout::undefined, true));
       b.memory(kCs, 0, kCs, 0);
       b.compute("w", {writes(x)});
       barrier(b);
       b.compute("r", {reads(x)});
     }},
    {"ExitNotCovered",
     "The exit state covers everything a frame leaves behind",
     {"boundary mismatch", "write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::transient);
       b.boundary(x, state(kCs, 0, Layout::undefined, true), state(kCs, 0, Layout::undefined, true));
       b.memory(kCs, 0, kCs, 0);
       b.compute("w", {writes(x)});
     }},
    {"EntryForgetsWrites",
     "The next entry covers the exit",
     {"boundary mismatch", "write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::transient);
       b.boundary(x, state(kCs, 0, Layout::undefined, true), state(kCs, kWrite, Layout::undefined, true));
       b.memory(kCs, 0, kCs, 0);
       b.compute("w", {writes(x)});
     }},
    {"HistoryRead",
     "prev(1) is the final version of the frame before",
     {},
     [](Builder& b) {
       const auto h = b.buffer("h");
       history(b, h, state(kCs, kWrite));
       const auto out = output(b, "out");
       b.memory(kCs, kWrite, kCs, kRead | kWrite);
       b.compute("use", {reads(h).prev(1), writes(out)});
       b.compute("w", {writes(h)});
     }},
    {"HistoryWrongAge",
     "prev(1) is the final version of the frame before",
     {"invalid plan"},
     [](Builder& b) {
       const auto h = b.buffer("h");
       history(b, h, state(kCs, kWrite));
       const auto out = output(b, "out");
       b.memory(kCs, kWrite, kCs, kRead | kWrite);
       b.compute("use", {reads(h).prev(1), writes(out)});
       b.compute("w", {writes(h)});
       b.plan.accesses[0].ref.age = 0;
     }},
    {"HistoryNotCarried",
     "Frames that do not write carry the version forward",
     {"wrong version"},
     [](Builder& b) {
       const auto h = b.buffer("h");
       history(b, h, state(kCs, kWrite));
       const auto out = output(b, "out");
       b.memory(kCs, kWrite, kCs, kRead | kWrite);
       b.compute("use", {reads(h).prev(1), writes(out)});
       b.condition(b.compute("w", {writes(h)}), "sometimes");
     }},
    {"ImportNotVisible",
     "What the engine wrote is made visible by the plan",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.source(x).before = {Role::storage, dsl::stage_compute, true};
       b.boundary(x, state(kCs, kWrite), state(st::fragment_shader | kCs, kWrite | kRead));
       b.raster("r", {reads(x, Role::storage, kFs)});
     }},
    {"ImportEntryTooWeak",
     "The entry state covers what the engine declares",
     {"boundary mismatch"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.source(x).before = {Role::storage, dsl::stage_compute, true};
       b.boundary(x, state(kCs, kRead), state(kCs, kRead));
       b.compute("r", {reads(x)});
     }},
    {"ImportReadAsDeclared",
     "Reads the engine has made possible need no barrier",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.source(x).before = {Role::storage, dsl::stage_compute, false};
       b.boundary(x, state(kCs, kRead), state(kCs, kRead));
       b.compute("r", {reads(x)});
     }},
    {"NotPresentable",
     "VUID-VkPresentInfoKHR-pImageIndices-01430: presented images are in PRESENT_SRC",
     {"boundary mismatch"},
     [](Builder& b) {
       const auto x = b.image("x");
       b.source(x).after = {Role::present, 0, false};
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared()});
     }},
    {"Presentable",
     "VUID-VkPresentInfoKHR-pImageIndices-01430: presented images are in PRESENT_SRC",
     {},
     [](Builder& b) {
       const auto x = b.image("x");
       b.source(x).after = {Role::present, 0, false};
       b.boundary(x, {}, state(0, 0, Layout::present_src));
       b.start(x, Layout::color_attachment, st::color_attachment_output, ac::color_attachment_write);
       b.raster("w", {writes(x, Role::color).cleared()});
       b.image_barrier(x, Layout::color_attachment, Layout::present_src, st::color_attachment_output, ac::color_attachment_write, 0, 0);
     }},

    // ---- shared memory ----
    {"HandOver", "Memory aliasing: the new owner's writes come after the old owner's accesses", {}, [](Builder& b) { aliased_pair(b); }},
    {"ReleaseForgetsStage",
     "Memory aliasing: a memory dependency from every last user",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.releases[0].stages = st::fragment_shader;
     }},
    {"ReleaseForgetsWrite",
     "Memory aliasing: unavailable writes of the old owner race with the new one",
     {"alias race"},
     [](Builder& b) {
       const Pair pair = aliased_pair(b);
       b.plan.steps.pop_back(), b.plan.steps.pop_back();  // the last barrier and reader of c
       b.plan.passes.pop_back(), b.plan.program_pass.pop_back();
       b.boundary(pair.c, state(kCs, kWrite, Layout::undefined, true), state(kCs, kWrite, Layout::undefined, true));
       b.plan.memory_barriers[0] = {kCs, kWrite, kCs, kWrite};
       b.source(dsl::ResourceId{size_t{2}}).is_output = false;
       b.plan.memory_barriers[2] = {kCs, kWrite, kCs, kWrite};
     }},
    {"TakenOverTooEarly",
     "Memory aliasing: contents are undefined after the other resource is written",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.acquires[1].group = b.plan.acquires[1].point = 1;
     }},
    {"AcquireTooNarrow",
     "Memory aliasing: the hand-over's second scope covers the first users",
     {"write-after-write"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.acquires[1].stages = st::fragment_shader;
     }},
    {"SharedWithoutClock",
     "Memory aliasing: bytes are shared only where one resource is known to be over before the other begins",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.alias_clocks[1] = kNone;
     }},
    {"ClockRunsAhead",
     "Memory aliasing: what comes after the acquire is not over before it",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.alias_clocks[0] = 3;
     }},
    {"UserAfterRelease",
     "Memory aliasing: a dependency from every user, those after the release's point as well",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       b.plan.releases[0].point = 1;
     }},
    {"OutputShared",
     "program: an output is observable at the end of the frame, so that nobody may take its memory before",
     {"alias race"},
     [](Builder& b) {
       const Pair pair = aliased_pair(b);
       b.source(pair.a).is_output = true;
     }},
    {"ImportedMemoryShared",
     "Only transients share memory",
     {"alias race"},
     [](Builder& b) {
       aliased_pair(b);
       hand_over(b, dsl::ResourceId{size_t{2}}, 1, kCs, kWrite, 4, kCs, kWrite);
     }},
    {"ImageOverBuffer",
     "Memory aliasing: an image takes over with a transition from UNDEFINED in the hand-over's group",
     {},
     [](Builder& b) {
       const auto a = b.buffer("a");
       const auto c = b.image("c");
       for (const auto id : {a, c}) {
         b.lifetime(id, dsl::Lifetime::transient);
         b.boundary(id, state(kCs, kWrite, Layout::undefined, true), state(kCs, kWrite, Layout::undefined, true));
         b.planned(id).estimated_bytes = 1024;
       }
       b.memory(kCs, kWrite, kCs, kWrite);
       b.compute("wa", {writes(a)});
       b.image_barrier(c, Layout::undefined, Layout::general, kCs, kWrite, kCs, kWrite);
       b.compute("wc", {writes(c)});
       hand_over(b, a, 0, kCs, kWrite, 1, kCs, kWrite);
       hand_over(b, c, 1, kCs, kWrite, 2, kCs, kWrite);
       b.plan.acquires[1].image_barrier = 0, b.plan.acquires[1].image_barriers = 1;
     }},
    {"ImageOverBufferElsewhere",
     "Memory aliasing: the transition must stand where memory changes hands",
     {"alias race"},
     [](Builder& b) {
       const auto a = b.buffer("a");
       const auto c = b.image("c", Format::rgba16f, 2);
       for (const auto id : {a, c}) {
         b.lifetime(id, dsl::Lifetime::transient);
         b.boundary(id, state(kCs, kWrite, Layout::undefined, true), state(kCs, kWrite, Layout::undefined, true));
       }
       b.memory(kCs, kWrite, kCs, kWrite);
       b.compute("wa", {writes(a)});
       b.image_barrier(c, Layout::undefined, Layout::general, kCs, kWrite, kCs, kWrite, {aspect_color, 0, 1, 0, 1});
       b.compute("w0", {writes(c).mip(0)});
       b.image_barrier(c, Layout::undefined, Layout::general, kCs, kWrite, kCs, kWrite, {aspect_color, 1, 1, 0, 1});
       b.compute("w1", {writes(c).mip(1)});
       hand_over(b, a, 0, kCs, kWrite, 1, kCs, kWrite);
       hand_over(b, c, 1, kCs, kWrite, 3, kCs, kWrite);
       b.plan.acquires[1].image_barrier = 0, b.plan.acquires[1].image_barriers = 1;
     }},
};

class FrameLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(FrameLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, FrameLitmus, ::testing::ValuesIn(kFrameCases), litmus_name);

}  // namespace
}  // namespace rg::verify
