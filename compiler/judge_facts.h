// The facts that `assert` and `warn` may name: each finds a figure in every plan of a graph, keeps the worst, and says what contributes most to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/plan_figures.h"
#include "compiler/plan_frame.h"

namespace rg::compiler {

struct Contributor {
  std::string name, share;  // "`hdr`", "31.6 MiB"
  dsl::Span span;
};
struct Finding {
  double value = 0;                       // a fact that just holds or not: 1 or 0
  bool bytes = false;                     // value is a number of bytes
  std::string verdict;                    // of a fact that does not hold: "separated by a barrier"
  std::string variant;                    // "fog=on", where the plans of a graph differ in it
  std::vector<Contributor> contributors;  // the greatest first, at most three
};
struct Question {
  const dsl::Program& program;
  dsl::GraphId graph;
  const std::vector<FramePlan>& plans;
  const std::vector<PlanFigures>& figures;  // of each plan
  const PlanOptions& options;
  const dsl::Assertion& assertion;
};
struct Fact {
  const char* name;
  const char* arguments;       // "", "(PASS, PASS)", ...: what it takes, as the message about a wrong one shows it
  size_t least = 0, most = 0;  // names it takes
  bool compares = true;        // takes a comparison with a number
  Finding (*find)(const Question& question);
};
const std::vector<Fact>& known_facts();

}  // namespace rg::compiler
