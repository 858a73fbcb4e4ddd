// Orders: legal on random graphs, compact, and better than program order where there is something to gain.
#include <random>

#include "compiler/segment_search.h"
#include "runtime/packing.h"
#include "tests/unit/plan/planned.h"

namespace rg::compiler {
namespace {

SegmentProblem random_problem(uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  SegmentProblem problem;
  problem.nodes = 2 + below(60);
  for (uint32_t node = 1; node < problem.nodes; ++node)
    for (uint32_t k = below(3); k > 0; --k) problem.edges.push_back({node - 1 - below(std::min(node, 8u)), node, below(5) != 0});
  for (uint32_t node = 0; node + 1 < problem.nodes; ++node)
    problem.items.push_back({1 + below(100), 1, {node, node + 1 + below(std::min(problem.nodes - node - 1, 6u))}});
  return problem;
}

// The random frames of bench/README.md in small: a pass reads up to four of the images of the sixteen passes before it and writes one or two.
SegmentProblem random_frame(uint32_t seed, uint32_t passes) {
  std::mt19937 random(seed);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  SegmentProblem problem;
  problem.nodes = passes;
  std::vector<std::vector<uint32_t>> outputs(passes);
  for (uint32_t pass = 0; pass < passes; ++pass) {
    for (uint32_t k = pass > 0 ? 1 + below(4) : 0; k > 0; --k) {
      const uint32_t from = pass - 1 - std::min(pass - 1, std::min(below(16), below(16)));
      problem.edges.push_back({from, pass});
      SegmentProblem::Item& read = problem.items[outputs[from][below(static_cast<uint32_t>(outputs[from].size()))]];
      if (read.users.back() != pass) read.users.push_back(pass);
    }
    const uint64_t texels = std::vector<uint64_t>{1920 * 1080, 960 * 540, 480 * 270}[below(3)];
    for (uint32_t k = 1 + below(2); k > 0; --k) {
      outputs[pass].push_back(static_cast<uint32_t>(problem.items.size()));
      problem.items.push_back({packing::detail::align_up(texels * (below(4) == 0 ? 8 : 4), 65536), 65536, {pass}});
    }
  }
  return problem;
}

bool is_legal(const SegmentProblem& problem, const Segments& segments) {
  for (const SegmentProblem::Edge& edge : problem.edges)
    if (segments[edge.before] + (edge.hard ? 1 : 0) > segments[edge.after]) return false;
  return true;
}

TEST(SegmentSearch, EveryCandidateIsLegal) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const SegmentProblem problem = random_problem(seed);
    const Segments earliest = earliest_segments(problem);
    const uint32_t count = cost_of(problem, earliest).segments + seed % 3;
    EXPECT_TRUE(is_legal(problem, earliest)) << seed;
    EXPECT_TRUE(is_legal(problem, program_order_segments(problem))) << seed;
    EXPECT_TRUE(is_legal(problem, latest_segments(problem, count))) << seed;
    EXPECT_TRUE(is_legal(problem, spread_segments(problem, count))) << seed;
    EXPECT_TRUE(is_legal(problem, anneal_segments(problem, spread_segments(problem, count), count, 2000, seed + 1))) << seed;
    EXPECT_TRUE(is_legal(problem, compact_segments(problem, latest_segments(problem, count + 5), UINT64_MAX))) << seed;
    const Segments drifted = drift_segments(problem, spread_segments(problem, count), 2000, seed + 1);
    EXPECT_TRUE(is_legal(problem, drifted)) << seed;
    EXPECT_LE(cost_of(problem, drifted).peak, cost_of(problem, spread_segments(problem, count)).peak) << seed;
  }
}

TEST(SegmentSearch, IsNeverWorseThanProgramOrder) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    const SegmentProblem problem = random_problem(seed);
    const Segments found = search_segments(problem, Effort::normal, Prefer::balance).best;
    EXPECT_TRUE(is_legal(problem, found)) << seed;
    const auto packed_score = [&](const Segments& order) {
      return score({cost_of(problem, order).segments, packed_bytes(problem, order, 3000 * problem.items.size())}, Prefer::balance);
    };
    EXPECT_LE(packed_score(found), packed_score(program_order_segments(problem))) << seed;
    EXPECT_EQ(found, search_segments(problem, Effort::normal, Prefer::balance).best) << "not deterministic, seed " << seed;
  }
}

// Chosen once packed: nearly every chosen order packs to its peak, and takes no more memory than program order.
TEST(SegmentSearch, ChosenOrdersPack) {
  size_t packed = 0, frames = 0;
  for (uint32_t seed = 0; seed < 24; ++seed, ++frames) {
    const SegmentProblem problem = random_frame(seed, 50 + seed * 5);
    const Segments found = search_segments(problem, Effort::normal, Prefer::balance).best, program = program_order_segments(problem);
    const SegmentCost cost = cost_of(problem, found), before = cost_of(problem, program);
    const uint64_t heap = packed_bytes(problem, found, 4000 * problem.items.size());
    EXPECT_TRUE(is_legal(problem, found)) << seed;
    EXPECT_LE(heap, before.peak) << seed;
    EXPECT_LE(score({cost.segments, heap}, Prefer::balance), score(before, Prefer::balance)) << seed;
    packed += heap == cost.peak;
  }
  EXPECT_GE(packed * 100, frames * 90);
}

TEST(SegmentSearch, AChainHasOneOrder) {
  SegmentProblem chain;
  chain.nodes = 40;
  chain.items.push_back({100, 1, {0}});
  for (uint32_t node = 1; node < chain.nodes; ++node) chain.edges.push_back({node - 1, node}), chain.items[0].users.push_back(node);
  const SegmentResult forced = search_segments(chain, Effort::normal, Prefer::balance);
  EXPECT_EQ(forced.evaluations, 0u);
  EXPECT_EQ(forced.best, earliest_segments(chain));
  ++chain.nodes;  // one that may stand anywhere
  EXPECT_GT(search_segments(chain, Effort::normal, Prefer::balance).evaluations, 0u);
}

TEST(SegmentSearch, CompactingJoinsOnlyWhatNothingSeparates) {
  SegmentProblem problem{.nodes = 3, .edges = {{0, 2, true}}, .items = {}};
  EXPECT_EQ(compact_segments(problem, {0, 4, 9}, UINT64_MAX), (Segments{0, 0, 1}));
}

// Two chains written one after the other: interleaved they share their barriers, and the second is small enough not to matter.
constexpr char kTwoChains[] =
    "image a0 : rgba16f view\n image a1 : rgba16f view\n buffer b0 : u32[4]\n buffer b1 : u32[4]\n"
    "pass a_first : compute { write a0 as storage }\n"
    "pass a_second : compute { read a0 as sampled  write a1 as storage }\n"
    "pass b_first : compute { write b0 as storage }\n"
    "pass b_second : compute { read b0 as storage  write b1 as storage }\n"
    "pass show : raster { read a1 as sampled in fragment  read b1 as storage in fragment  color backbuffer covers }\n";

TEST(Schedule, IndependentChainsShareTheirBarriers) {
  EXPECT_EQ(order_text(plan_of(kTwoChains).plan), "| a_first b_first | a_second b_second | show | ");
}

// Three images live at once instead of four are worth a barrier more.
TEST(Schedule, MemoryIsWorthABarrier) {
  EXPECT_EQ(order_text(plan_of("image a0 : rgba16f view\n image a1 : rgba16f view\n image b0 : rgba16f view\n image b1 : rgba16f view\n"
                               "pass a_first : compute { write a0 as storage }\n"
                               "pass a_second : compute { read a0 as sampled  write a1 as storage }\n"
                               "pass b_first : compute { write b0 as storage }\n"
                               "pass b_second : compute { read b0 as sampled  write b1 as storage }\n"
                               "pass show : raster { read a1 as sampled in fragment  read b1 as sampled in fragment  color backbuffer covers }\n")
                           .plan),
            "| a_first | a_second b_first | b_second | show | ");
}

TEST(Schedule, ProgramOrderOnRequest) {
  EXPECT_EQ(order_text(plan_of(kTwoChains, {.reorder = false}).plan), "| a_first | a_second b_first | b_second | show | ");
}

TEST(Schedule, OneGroupAPassWithoutMerging) {
  const FramePlan frame = plan_of(kTwoChains, {.merge = false});
  ASSERT_EQ(frame.plan.steps.size(), 2 * frame.plan.passes.size() + 1);
  for (size_t i = 0; i < frame.plan.steps.size(); ++i) EXPECT_EQ(frame.plan.steps[i].kind, i % 2 == 0 ? StepKind::barriers : StepKind::pass) << i;
}

TEST(Schedule, AfterKeepsAnOrderWithoutABarrier) {
  const std::string body =
      "buffer x : u32[4] output\n buffer y : u32[4] output\n"
      "pass one : compute { write x as storage }\n"
      "pass two : compute { write y as storage  after one }\n"
      "pass show : raster { color backbuffer covers }\n";
  const std::string order = order_text(plan_of(body).plan);
  EXPECT_LT(order.find("one"), order.find("two"));
  EXPECT_EQ(order.substr(order.find("one"), order.find("two") - order.find("one")).find('|'), std::string::npos);
}

}  // namespace
}  // namespace rg::compiler
