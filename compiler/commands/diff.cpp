#include <fmt/format.h>

#include <algorithm>

#include "compiler/commands/command.h"
#include "compiler/commands/facts.h"
#include "compiler/commands/plan_text.h"

namespace rg::commands {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

using Lines = std::vector<std::string>;

// Lines that two texts have in common at their beginning and at their end.
std::pair<size_t, size_t> common_ends(const Lines& a, const Lines& b) {
  size_t head = 0, tail = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) ++head;
  while (tail + head < a.size() && tail + head < b.size() && a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) ++tail;
  return {head, tail};
}

// Lines only in the one (-) or only in the other (+), in order, by a longest common subsequence; O(n m) in the lines that differ.
std::string line_diff(Lines a, Lines b) {
  std::vector<std::vector<uint32_t>> common(a.size() + 1, std::vector<uint32_t>(b.size() + 1, 0));
  for (size_t i = a.size(); i-- > 0;)
    for (size_t j = b.size(); j-- > 0;) common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
  std::string text;
  for (size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (i < a.size() && j < b.size() && a[i] == b[j])
      ++i, ++j;
    else if (i < a.size() && (j == b.size() || common[i + 1][j] >= common[i][j + 1]))
      text += "- " + a[i++] + "\n";
    else
      text += "+ " + b[j++] + "\n";
  }
  return text;
}

constexpr size_t kMaxCells = 50'000'000;  // of the table above; beyond that the middle is shown as replaced

std::string text_diff(const std::string& before, const std::string& after) {
  Lines a = lines_of(before), b = lines_of(after);
  const auto [head, tail] = common_ends(a, b);
  const auto middle = [&, head = head, tail = tail](const Lines& lines) { return Lines(lines.begin() + head, lines.end() - tail); };
  a = middle(a), b = middle(b);
  if (a.size() * b.size() > kMaxCells) return line_diff(a, {}) + line_diff({}, b);
  return line_diff(a, b);
}

std::string facts_text(const Facts& facts) {
  return fmt::format(
      "passes {}\nculled {}\nrenderings {}\nheap bytes {}\nunaliased bytes {}\nbarriers {} in {} calls\nsubmits {}\nwaits {}\nqueues {}\nmodelled "
      "time {:.1f} us\n",
      facts.passes_live, facts.passes_culled, facts.renderings, facts.heap_bytes, facts.unaliased_bytes, facts.barriers, facts.barrier_calls,
      facts.submits, facts.waits, facts.queues, facts.overlap.end / 1000);
}

// The plan of one graph with one choice of features.
struct Block {
  std::string title, text;
};

std::vector<Block> blocks_of(const compiler::CompileResult& result) {
  std::vector<Block> blocks;
  for (const compiler::CompiledGraph& graph : result.graphs) {
    for (const compiler::FramePlan& plan : graph.plans) {
      const Facts facts = find_facts(result.program, graph, plan);
      std::string text = facts_text(facts);
      for (const Pass& pass : plan.plan.passes)
        text += fmt::format("pass {}{}\n", pass.name, pass.queue ? fmt::format("  on queue {}", pass.queue) : "");
      for (const compiler::Fold& fold : result.folded)
        for (const compiler::Fold::Part& part : fold.parts)
          if (fold.graph == graph.graph) text += fmt::format("pass {}  folded into {}\n", fold.pass, part.into);
      blocks.push_back({facts.variant.empty() ? fmt::format("graph {}", facts.graph) : fmt::format("graph {} with {}", facts.graph, facts.variant),
                        text + barriers_text(plan.plan)});
    }
  }
  return blocks;
}

const Block* find_block(const std::vector<Block>& blocks, const std::string& title) {
  const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const Block& block) { return block.title == title; });
  return found == blocks.end() ? nullptr : &*found;
}

// A block of changes for each plan that differs, under its title.
std::string changes_between(const std::vector<Block>& before, const std::vector<Block>& after) {
  std::string text;
  for (const Block& old : before) {
    const Block* now = find_block(after, old.title);
    const std::string changes = now == nullptr ? "" : text_diff(old.text, now->text);
    if (now == nullptr) text += old.title + ": there is no such plan any more\n";
    if (!changes.empty()) text += old.title + "\n" + changes;
  }
  for (const Block& now : after)
    if (find_block(before, now.title) == nullptr) text += now.title + ": a new plan\n" + text_diff("", now.text);
  return text;
}

}  // namespace

int diff(const DiffOptions& options) {
  compiler::CompileOptions compile = options.compile;
  compile.until = compiler::Until::plans;
  const auto before = compile_or_report(options.before, compile);
  const auto after = compile_or_report(options.after, compile);
  if (!before || !after) return exit_input_wrong;
  const std::string changes = changes_between(blocks_of(*before), blocks_of(*after));
  print(changes.empty() ? "the plans are equal\n" : changes);
  return exit_done;
}

}  // namespace rg::commands
