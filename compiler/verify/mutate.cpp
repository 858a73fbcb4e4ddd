#include "compiler/verify/mutate.h"

#include <algorithm>

#include "compiler/verify/alias.h"
#include "compiler/verify/harmless.h"

namespace rg::verify {
namespace {

template <class Row>
using Column = std::span<const Row> Plan::*;

const char* tag_name(BarrierTag tag) {
  switch (tag) {
    case BarrierTag::hazard:
      return "";
    case BarrierTag::valid_usage:
      return "tagged: valid usage";
    case BarrierTag::workaround:
      return "tagged: work-around";
    case BarrierTag::merged_batch:
      return "tagged: merged batch";
    case BarrierTag::boundary_join:
      return "tagged: boundary join";
    case BarrierTag::alias_pair:
      return "tagged: alias pair";
  }
  return "tagged";
}

// The class that explains more, if any does.
const std::string& either(const std::string& first, const std::string& second) { return first.empty() ? second : first; }

class Mutator {
 public:
  Mutator(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
          const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource, const MutateOptions& options)
      : program_(program),
        graph_(graph),
        configuration_(configuration),
        plan_(plan),
        program_pass_(program_pass),
        program_resource_(program_resource),
        options_(options),
        harmless_(program, graph, plan, program_pass) {}

  MutationReport run() {
    each("barrier", plan_.memory_barriers, [&](Index i) { masks(&Plan::memory_barriers, i, "memory barrier"); });
    each("barrier", plan_.image_barriers, [&](Index i) { image(i); });
    each("barrier", plan_.buffer_barriers, [&](Index i) { buffer(i); });
    each("attachment", plan_.attachments, [&](Index i) { attachment(i); });
    each("hand-off", plan_.releases, [&](Index i) { release(i); });
    each("hand-off", plan_.acquires, [&](Index i) { acquire(i), clocks(i); });
    each("order", plan_.steps, [&](Index i) { order(i); });
    each("event", plan_.steps, [&](Index i) { event(i); });
    each("placement", plan_.acquires, [&](Index i) { placement(i); });
    each("wait", plan_.waits, [&](Index i) { wait(i); });
    each("signal", plan_.signals, [&](Index i) { signal(i); });
    each("queue", plan_.batches, [&](Index i) { other_queue(i); });
    each("ownership", plan_.image_barriers, [&](Index i) { transfer(&Plan::image_barriers, i); });
    each("ownership", plan_.buffer_barriers, [&](Index i) { transfer(&Plan::buffer_barriers, i); });
    each("ownership", plan_.resources, [&](Index i) { sharing(i); });
    each("lazy", plan_.attachments, [&](Index i) { lazy(i); });
    return std::move(report_);
  }

 private:
  template <class Rows, class Visit>
  void each(const char* kind, const Rows& rows, Visit visit) {
    kind_ = kind;
    for (Index i = 0; i < rows.size(); ++i) visit(i);
  }

  // ---- one mutant -------------------------------------------------------------------------------------------------------

  bool is_proved(const Plan& mutant) const {
    VerifyOptions verify_options;
    verify_options.irredundancy = false;
    verify_options.max_findings = 1;
    return verify(program_, graph_, configuration_, mutant, program_pass_, program_resource_, verify_options).empty();
  }

  // `harmless`: the class to which the mutant belongs if it survives; empty: it must not.
  void judge(const Plan& mutant, const std::string& what, const std::string& harmless) {
    if ((turn_++ + options_.every - options_.first % options_.every) % options_.every != 0) return;
    ++report_.mutants;
    KindReport& kind = report_.kinds[kind_];
    ++kind.made;
    if (options_.progress) options_.progress(report_.mutants);
    if (!is_proved(mutant)) {
      ++report_.killed, ++kind.killed;
      if (options_.misbehaves && options_.ask_every != 0 && report_.killed % options_.ask_every == 0 && kind.asked < options_.ask_at_most)
        ++kind.asked, kind.agreed += options_.misbehaves(mutant);
    } else if (is_asked(harmless) && options_.misbehaves(mutant)) {
      report_.survivors.push_back(what + " (the second opinion is that this is wrong)");
    } else if (!harmless.empty()) {
      ++report_.equivalent[harmless];
    } else {
      report_.survivors.push_back(what);
    }
  }

  bool is_asked(const std::string& harmless) {
    if (!options_.misbehaves) return false;
    if (harmless.empty()) return true;
    size_t& asked = report_.confirmed[harmless];
    return asked < options_.ask_at_most && ++asked > 0;
  }

  template <class Row, class Change>
  void change(Column<Row> column, Index at, Change apply, const std::string& what, const std::string& harmless = {}) {
    std::vector<Row> rows((plan_.*column).begin(), (plan_.*column).end());
    apply(rows[at]);
    Plan mutant = plan_;
    mutant.*column = rows;
    judge(mutant, what, harmless);
  }

  // The row leaves its table; groups, and acquires of images, are renumbered.
  template <class Row>
  void remove(Column<Row> column, Index BarrierGroup::*first, Index BarrierGroup::*count, Index at, const std::string& what,
              const std::string& harmless) {
    std::vector<Row> rows((plan_.*column).begin(), (plan_.*column).end());
    rows.erase(rows.begin() + at);
    std::vector<BarrierGroup> groups(plan_.groups.begin(), plan_.groups.end());
    for (BarrierGroup& group : groups) {
      if (at >= group.*first && at < group.*first + group.*count) --(group.*count);
      if (group.*first > at) --(group.*first);
    }
    std::vector<Acquire> acquires(plan_.acquires.begin(), plan_.acquires.end());
    if constexpr (std::is_same_v<Row, ImageBarrier>)
      for (Acquire& acquire : acquires) {
        if (acquire.image_barrier == kNone) continue;
        if (at >= acquire.image_barrier && at < acquire.image_barrier + acquire.image_barriers) --acquire.image_barriers;
        if (acquire.image_barrier > at) --acquire.image_barrier;
        if (acquire.image_barriers == 0) acquire.image_barrier = kNone;
      }
    Plan mutant = plan_;
    mutant.*column = rows, mutant.groups = groups, mutant.acquires = acquires;
    judge(mutant, what, harmless);
  }

  // ---- elements -----------------------------------------------------------------------------------------------------------

  template <class Row, class Mask>
  void clear_bits(Column<Row> column, Index at, Mask Row::*mask, const std::string& what, const std::string& harmless) {
    clear_each(column, at, mask, what, [&](Mask) { return harmless; });
  }
  template <class Row, class Mask, class Class>
  void clear_each(Column<Row> column, Index at, Mask Row::*mask, const std::string& what, Class harmless) {
    for (Mask rest = (plan_.*column)[at].*mask; rest != 0; rest &= rest - 1) {
      const Mask bit = rest & ~(rest - 1);
      change(
          column, at, [&](Row& row) { row.*mask &= ~bit; }, what + " without bit " + std::to_string(bit), harmless(bit));
    }
  }

  template <class Row>
  void masks(Column<Row> column, Index at, const std::string& what) {
    const Row& row = (plan_.*column)[at];
    const std::string harmless = tag_name(row.tag), name = what + " " + std::to_string(at);
    clear_bits(column, at, &Row::src_stages, name + ", source stages", harmless);
    clear_bits(column, at, &Row::src_accesses, name + ", source accesses", harmless);
    if constexpr (std::is_same_v<Row, ImageBarrier>) {
      clear_each(column, at, &Row::dst_stages, name + ", destination stages",
                 [&](Stages bit) { return either(harmless, harmless_.unseen(at, bit, 0)); });
      clear_each(column, at, &Row::dst_accesses, name + ", destination accesses",
                 [&](Accesses bit) { return either(harmless, harmless_.unseen(at, 0, bit)); });
    } else {
      clear_bits(column, at, &Row::dst_stages, name + ", destination stages", harmless);
      clear_bits(column, at, &Row::dst_accesses, name + ", destination accesses", harmless);
    }
  }

  std::string resource_name(const Ref& ref) const { return std::string(plan_.resources[ref.resource].name); }

  void image(Index at) {
    const ImageBarrier& row = plan_.image_barriers[at];
    const std::string what = "image barrier on " + resource_name(row.image), harmless = tag_name(row.tag);
    remove(&Plan::image_barriers, &BarrierGroup::first_image, &BarrierGroup::image_count, at, what + " " + std::to_string(at) + " removed", harmless);
    masks(&Plan::image_barriers, at, what);
    const Layout other = row.new_layout == Layout::general ? Layout::shader_read_only : Layout::general;
    change(
        &Plan::image_barriers, at, [&](ImageBarrier& b) { b.new_layout = other; }, what + ", another new layout");
    if (row.old_layout != Layout::undefined)
      change(
          &Plan::image_barriers, at, [](ImageBarrier& b) { b.old_layout = Layout::undefined; }, what + ", contents discarded",
          harmless_.without_contents(row));
    if (row.range.mips != kRemaining && row.range.mips > 1)
      change(
          &Plan::image_barriers, at, [](ImageBarrier& b) { --b.range.mips; }, what + ", last mip left out",
          either(harmless_.narrower(at, row.range.mip + row.range.mips - 1, row.range.layer), harmless));
    if (row.range.layers != kRemaining && row.range.layers > 1)
      change(
          &Plan::image_barriers, at, [](ImageBarrier& b) { --b.range.layers; }, what + ", last layer left out",
          either(harmless_.narrower(at, row.range.mip, row.range.layer + row.range.layers - 1), harmless));
  }

  void buffer(Index at) {
    const std::string what = "buffer barrier on " + resource_name(plan_.buffer_barriers[at].buffer);
    remove(&Plan::buffer_barriers, &BarrierGroup::first_buffer, &BarrierGroup::buffer_count, at, what + " " + std::to_string(at) + " removed",
           tag_name(plan_.buffer_barriers[at].tag));
    masks(&Plan::buffer_barriers, at, what);
  }

  void attachment(Index at) {
    const Attachment& row = plan_.attachments[at];
    const std::string what = "attachment " + resource_name(row.ref);
    if (row.load == LoadOp::load)
      change(
          &Plan::attachments, at, [](Attachment& a) { a.load = LoadOp::dont_care; }, what + " not loaded");
    if (row.load == LoadOp::clear)
      change(
          &Plan::attachments, at, [](Attachment& a) { a.load = LoadOp::dont_care; }, what + " not cleared");
    if (row.store == StoreOp::store)
      change(
          &Plan::attachments, at, [](Attachment& a) { a.store = StoreOp::dont_care; }, what + " not stored", harmless_.not_stored(at));
  }

  void release(Index at) {
    const std::string what = "release of " + std::string(plan_.resources[plan_.releases[at].resource].name);
    const bool can_hand_on = may_share(plan_)[plan_.releases[at].resource];
    const std::string harmless = can_hand_on ? "" : "release of memory that is never shared";
    // One of several stages may be ordered before every possible taker by the frame's own barriers.
    const Stages stages = plan_.releases[at].stages;
    const std::string implied = can_hand_on && (stages & (stages - 1)) != 0 ? "release stage that leads to another one of the row" : harmless;
    clear_bits(&Plan::releases, at, &Release::stages, what + ", stages", implied);
    clear_bits(&Plan::releases, at, &Release::accesses, what + ", accesses", harmless);
    if (plan_.releases[at].point > 0)
      change(
          &Plan::releases, at, [](Release& r) { --r.point; }, what + ", a point too early", either(harmless_.released_earlier(at), harmless));
  }

  // Of buffers; an image's own barrier says what its acquire says.
  void acquire(Index at) {
    const Acquire& row = plan_.acquires[at];
    if (!may_share(plan_)[row.resource] || plan_.resources[row.resource].kind == ResourceKind::image) return;
    const std::string what = "acquire of " + std::string(plan_.resources[row.resource].name);
    clear_bits(&Plan::acquires, at, &Acquire::stages, what + ", stages", {});
    clear_bits(&Plan::acquires, at, &Acquire::accesses, what + ", accesses", {});
  }

  // A point more than is known, of each queue, in this frame and the one before.
  void clocks(Index at) {
    const Acquire& row = plan_.acquires[at];
    if (row.first_clock == kNone) return;
    for (Index c = 0; c < 2 * plan_.queues.size(); ++c) {
      if (c == plan_.queues.size() + row.queue) continue;  // all of the frame before is over on the own queue
      const std::string what = "clock " + std::to_string(c) + " of " + std::string(plan_.resources[row.resource].name) + " too far";
      change(
          &Plan::alias_clocks, row.first_clock + c, [](Index& clock) { clock = clock == kNone ? 0 : clock + 1; }, what,
          "clock that could count more");
    }
  }

  // ---- submission ---------------------------------------------------------------------------------------------------------

  void wait(Index at) {
    const Wait& row = plan_.waits[at];
    const std::string what = "wait " + std::to_string(at) + " for queue " + std::to_string(row.queue);
    std::vector<Wait> rows(plan_.waits.begin(), plan_.waits.end());
    rows.erase(rows.begin() + at);
    std::vector<Batch> batches(plan_.batches.begin(), plan_.batches.end());
    for (Batch& batch : batches) {
      if (at >= batch.first_wait && at < batch.first_wait + batch.wait_count) --batch.wait_count;
      if (batch.first_wait > at) --batch.first_wait;
    }
    Plan mutant = plan_;
    mutant.waits = rows, mutant.batches = batches;
    judge(mutant, what + " removed", {});
    clear_each(&Plan::waits, at, &Wait::stages, what + ", stages", [&](Stages bit) { return harmless_.unwaited(at, bit); });
    if (row.value > 1)
      change(
          &Plan::waits, at, [](Wait& w) { --w.value; }, what + ", for an earlier value",
          row.frames_ago ? "value of the frame before that a later frame implies" : "");
    if (row.frames_ago == 0)
      change(
          &Plan::waits, at, [](Wait& w) { w.frames_ago = 1; }, what + ", for the frame before");
  }

  void signal(Index at) {
    const Signal& row = plan_.signals[at];
    const std::string what = "signal " + std::to_string(at);
    clear_bits(&Plan::signals, at, &Signal::stages, what + ", stages", {});
    if ((row.stages & stage::all_commands) != 0)
      change(
          &Plan::signals, at, [](Signal& s) { s.stages = stage::clear; }, what + ", after clears only", "last signal that only the host waits for");
    change(
        &Plan::signals, at, [](Signal& s) { ++s.value; }, what + ", another value");
  }

  // The first pass of the batch runs at the end of the next batch of another queue.
  void other_queue(Index at) {
    const Batch& from = plan_.batches[at];
    Index to = at;
    while (to < plan_.batches.size() && plan_.batches[to].queue == from.queue) ++to;
    Index step = from.first_step;
    while (step < from.first_step + from.step_count && plan_.steps[step].kind != StepKind::pass) ++step;
    if (to == plan_.batches.size() || step == from.first_step + from.step_count) return;
    std::vector<Step> steps;
    std::vector<Batch> batches(plan_.batches.begin(), plan_.batches.end());
    for (Index b = 0; b < batches.size(); ++b) {
      const Index first = static_cast<Index>(steps.size());
      for (Index s = plan_.batches[b].first_step; s < plan_.batches[b].first_step + plan_.batches[b].step_count; ++s)
        if (s != step) steps.push_back(plan_.steps[s]);
      if (b == to) steps.push_back(plan_.steps[step]);
      batches[b].first_step = first, batches[b].step_count = static_cast<Index>(steps.size()) - first;
    }
    Plan mutant = plan_;
    mutant.steps = steps, mutant.batches = batches;
    judge(mutant, "pass " + std::string(plan_.passes[plan_.steps[step].index].name) + " on another queue", "pass that waits for nothing there");
  }

  // ---- ownership ----------------------------------------------------------------------------------------------------------

  template <class Row>
  void transfer(Column<Row> column, Index at) {
    const Row& row = (plan_.*column)[at];
    if (row.src_queue == row.dst_queue) return;
    const std::string what = "ownership transfer " + std::to_string(at);
    change(
        column, at, [](Row& b) { b.src_queue = b.dst_queue = kNone; }, what + " as a plain barrier");
    change(
        column, at, [](Row& b) { std::swap(b.src_queue, b.dst_queue); }, what + " the other way");
  }

  void sharing(Index at) {
    if (!plan_.resources[at].concurrent) return;
    change(
        &Plan::resources, at, [](Resource& r) { r.concurrent = false; }, std::string(plan_.resources[at].name) + " not shared",
        "shared by one family only");
  }

  // ---- memory that holds nothing between renderings ---------------------------------------------------------------------------

  void lazy(Index at) {
    const Index resource = plan_.attachments[at].ref.resource;
    const auto same = [&](const Attachment& row) { return row.ref.resource == resource; };
    const bool first = std::find_if(plan_.attachments.begin(), plan_.attachments.end(), same) == plan_.attachments.begin() + at;
    if (!first || plan_.resources[resource].lazy || plan_.resources[resource].lifetime != Lifetime::transient) return;
    change(
        &Plan::resources, resource, [](Resource& r) { r.lazy = true; }, std::string(plan_.resources[resource].name) + " in lazily allocated memory");
  }

  // ---- events -------------------------------------------------------------------------------------------------------------

  // Set in front of the passes that it follows, awaited behind those that it precedes.
  void event(Index at) {
    const Step step = plan_.steps[at];
    if (step.kind == StepKind::pass || plan_.groups[step.index].event == kNone) return;
    const auto batch = std::find_if(plan_.batches.begin(), plan_.batches.end(), [&](const Batch& b) { return at < b.first_step + b.step_count; });
    const bool sets = step.kind == StepKind::set;
    const Index begin = batch->first_step, end = batch->first_step + batch->step_count;
    const auto is_pass = [&](Index s) { return plan_.steps[s].kind == StepKind::pass; };
    Index to = at, passed = 0;
    if (sets)
      while (to > begin && (passed == 0 || is_pass(to - 1))) passed += is_pass(--to);
    else
      while (to + 1 < end && (passed == 0 || is_pass(to + 1))) passed += is_pass(++to);
    if (passed == 0) return;
    std::vector<Step> steps(plan_.steps.begin(), plan_.steps.end());
    steps.erase(steps.begin() + at);
    steps.insert(steps.begin() + to, step);
    Plan mutant = plan_;
    mutant.steps = steps;
    judge(mutant, "event " + std::to_string(plan_.groups[step.index].event) + (sets ? " set earlier" : " awaited later"),
          harmless_.moved(step.index, std::min(at, to), std::max(at, to), sets));
  }

  // ---- order --------------------------------------------------------------------------------------------------------------

  void order(Index at) {
    if (at + 1 == plan_.steps.size() || plan_.steps[at].kind != StepKind::pass) return;
    Index next = at + 1;
    while (next < plan_.steps.size() && plan_.steps[next].kind != StepKind::pass) ++next;
    if (next == plan_.steps.size()) return;
    std::vector<Step> steps(plan_.steps.begin(), plan_.steps.end());
    std::swap(steps[at], steps[next]);
    Plan mutant = plan_;
    mutant.steps = steps;
    const Pass &a = plan_.passes[plan_.steps[at].index], &b = plan_.passes[plan_.steps[next].index];
    judge(mutant, "passes " + std::string(a.name) + " and " + std::string(b.name) + " exchanged", harmless_.exchanged(at));
  }

  // ---- placement ------------------------------------------------------------------------------------------------------------

  void placement(Index at) {
    if (at + 1 == plan_.acquires.size()) return;
    const Index a = plan_.acquires[at].resource, b = plan_.acquires[at + 1].resource;
    const uint64_t offset = plan_.resources[b].estimated_offset;
    change(
        &Plan::resources, a, [&](Resource& resource) { resource.estimated_offset = offset; },
        std::string(plan_.resources[a].name) + " placed on " + std::string(plan_.resources[b].name), "places that may meet");
  }

  const dsl::Program& program_;
  dsl::GraphId graph_;
  const std::vector<uint32_t>& configuration_;
  const Plan& plan_;
  const std::vector<uint32_t>& program_pass_;
  const std::vector<uint32_t>& program_resource_;
  const MutateOptions& options_;
  const Harmless harmless_;
  size_t turn_ = 0;
  std::string kind_;
  MutationReport report_;
};

}  // namespace

MutationReport mutate(const dsl::Program& program, dsl::GraphId graph, const std::vector<uint32_t>& configuration, const Plan& plan,
                      const std::vector<uint32_t>& program_pass, const std::vector<uint32_t>& program_resource, const MutateOptions& options) {
  return Mutator(program, graph, configuration, plan, program_pass, program_resource, options).run();
}

}  // namespace rg::verify
