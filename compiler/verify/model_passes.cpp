#include "compiler/verify/model_passes.h"

#include <algorithm>

namespace rg::verify {
namespace {

using Extents = std::vector<int64_t>;

void for_each_attachment(const Plan& plan, const Rendering& rendering, auto visit) {
  for (uint32_t i = 0; i < rendering.color_count; ++i) visit(plan.attachments[rendering.first_color + i]);
  if (rendering.depth != kNone) visit(plan.attachments[rendering.depth]);
  if (rendering.stencil != kNone) visit(plan.attachments[rendering.stencil]);
}

// The attachment row that serves `access`, with its role among colour, depth and stencil.
const Attachment* find_attachment(const Model& model, const Pass& pass, const dsl::Access& access) {
  const Plan& plan = model.input->plan;
  if (pass.rendering == kNone) return nullptr;
  const Rendering& rendering = plan.renderings[pass.rendering];
  const auto serves = [&](const Attachment& row) {
    if (model.input->program_resource[row.ref.resource] != access.resource.value || row.ref.age != access.age) return false;
    const Shape& shape = model.resources[access.resource.value].partition.shape;
    dsl::Range wanted = effective_range(access, shape.aspects);
    Box box = box_of(model.input->program, shape, wanted, {}), planned = box_of(shape, row.range);
    planned.aspects = box.aspects = 0;
    return box == planned;
  };
  if (access.role == dsl::Role::stencil)
    return rendering.stencil != kNone && serves(plan.attachments[rendering.stencil]) ? &plan.attachments[rendering.stencil] : nullptr;
  if (access.role != dsl::Role::color)
    return rendering.depth != kNone && serves(plan.attachments[rendering.depth]) ? &plan.attachments[rendering.depth] : nullptr;
  for (uint32_t i = 0; i < rendering.color_count; ++i)
    if (serves(plan.attachments[rendering.first_color + i])) return &plan.attachments[rendering.first_color + i];
  return nullptr;
}

struct PlanRow {
  std::vector<uint32_t> cells;
  const Access* row = nullptr;
  uint32_t resource = 0;
};

std::vector<PlanRow> rows_of(const Model& model, const Pass& pass, const Extents& extents) {
  std::vector<PlanRow> rows;
  for (uint32_t i = pass.first_access; i < pass.first_access + pass.access_count; ++i) {
    const Access& row = model.input->plan.accesses[i];
    const uint32_t resource = model.input->program_resource[row.ref.resource];
    const Partition& partition = model.resources[resource].partition;
    const Box box = partition.shape.image ? box_of(partition.shape, row.range) : box_of(model.input->plan.exprs, partition.shape, row.bytes, extents);
    rows.push_back({cells_in(partition, box), &row, resource});
  }
  return rows;
}

// All rows that speak of the cell, joined.
struct Listed {
  bool any = false;
  StageSet stages = 0;
  AccessSet accesses = 0;
  Layout layout = Layout::undefined;
};
Listed listed(const std::vector<PlanRow>& rows, const Use& use, uint32_t cell) {
  Listed result;
  for (const PlanRow& row : rows) {
    if (row.resource != use.resource || row.row->ref.age != use.age || !std::binary_search(row.cells.begin(), row.cells.end(), cell)) continue;
    result.any = true;
    result.stages |= expand_stages(row.row->stages);
    result.accesses |= expand_accesses(row.row->accesses);
    result.layout = row.row->layout;
  }
  return result;
}

struct PassContext {
  Model& model;
  const Extents& extents;
  Report& report;
};

void report_pass(const PassContext& context, Hazard hazard, const PassNode& node, uint32_t resource, const std::string& text) {
  const std::string pass = context.model.pass_name(node.plan_pass), name = context.model.resource(resource).name;
  context.report.add({hazard, name, pass, "", "`" + pass + "` and `" + name + "`: " + text});
}

// Takes layouts from the plan's rows and demands that the rows name what the access does.
void take_rows(const PassContext& context, PassNode& node, Use& use, const std::vector<PlanRow>& rows) {
  const bool image = context.model.resources[use.resource].partition.shape.image;
  const dsl::Pass& pass = context.model.pass(node.plan_pass);
  for (const uint32_t cell : use.cells) {
    const Listed row = listed(rows, use, cell);
    use.layouts.push_back(row.layout);
    if (!row.any) {
      report_pass(context, Hazard::invalid_plan, node, use.resource, "the plan's pass does not list this access");
      continue;
    }
    for (const Touch& touch : use.touches)
      if (touch.needed && ((touch.stages & ~row.stages) || (touch.accesses & ~row.accesses)))
        report_pass(context, Hazard::invalid_plan, node, use.resource, "the plan's row names other stages or accesses than the program declares");
    const uint32_t aspect = aspect_of_cell(context.model.resources[use.resource].partition, cell);
    if (image && !is_legal_layout(pass, pass.accesses[use.access], aspect, layout_of_aspect(row.layout, aspect)))
      report_pass(context, Hazard::wrong_layout, node, use.resource, "layout " + layout_name(row.layout) + " does not allow this access");
  }
}

void take_attachment(const PassContext& context, const PassNode& node, const dsl::Access& access, Use& use) {
  const Pass& pass = context.model.input->plan.passes[node.plan_pass];
  const Attachment* row = find_attachment(context.model, pass, access);
  use.attachment = true;
  if (!row) {
    report_pass(context, Hazard::invalid_plan, node, use.resource, "the rendering lacks this attachment");
    return;
  }
  use.load = row->load, use.store = row->store;
  use.touches = touches_of_attachment(access, use.load, use.store);
}

Use make_use(const PassContext& context, PassNode& node, uint32_t index, const std::vector<PlanRow>& rows) {
  const Model& model = context.model;
  const dsl::Pass& pass = model.pass(node.plan_pass);
  const dsl::Access& access = pass.accesses[index];
  Use use;
  use.resource = access.resource.value;
  use.age = access.age;
  use.access = index;
  const Partition& partition = model.resources[use.resource].partition;
  use.cells = cells_in(partition, box_of(model.input->program, partition.shape, effective_range(access, partition.shape.aspects), context.extents));
  use.orders.assign(use.cells.size(), 0);
  use.uses_contents = uses_contents(pass, access);
  use.writes = writes_contents(access);
  use.commutes = commutes(access);
  use.clears = access.clear.has_value();
  use.own_slices = is_slice(access) && (access.clear || access.covers);
  if (is_attachment(access.role))
    take_attachment(context, node, access, use);
  else {
    use.touches = touches_of(pass, access, use.cells.empty() ? 0 : listed(rows, use, use.cells.front()).stages);
  }
  take_rows(context, node, use, rows);
  return use;
}

}  // namespace

void add_pass(Model& model, const std::vector<int64_t>& extents, uint32_t index, Report& report) {
  const PassContext context{model, extents, report};
  const Pass& pass = model.input->plan.passes[index];
  PassNode& node = model.passes[index];
  node.plan_pass = index;
  node.program_pass = model.input->program_pass[index];
  const dsl::Pass& source = model.input->graph.passes.rows[node.program_pass];
  const std::vector<PlanRow> rows = rows_of(model, pass, context.extents);
  for (uint32_t i = 0; i < source.accesses.size(); ++i)
    if (model.resources[source.accesses[i].resource.value].plan != kNone)
      node.uses.push_back(make_use(context, node, i, rows));
    else
      report_pass(context, Hazard::invalid_plan, node, source.accesses[i].resource.value, "the plan lacks the resource");
  if (pass.rendering == kNone) return;
  // Every attachment of the plan belongs to an access of the program.
  for_each_attachment(model.input->plan, model.input->plan.renderings[pass.rendering], [&](const Attachment& row) {
    const bool declared = std::any_of(source.accesses.begin(), source.accesses.end(), [&](const dsl::Access& access) {
      return is_attachment(access.role) && find_attachment(model, pass, access) == &row;
    });
    if (!declared)
      report_pass(context, Hazard::invalid_plan, node, model.input->program_resource[row.ref.resource],
                  "the rendering has an attachment that the pass does not declare");
  });
}

void number_renderings(Model& model) {
  uint32_t next = 0;
  const PassNode* open = nullptr;
  for (const StepNode& step : model.steps) {
    if (!step.is_pass) {  // every batch ends with one
      open = nullptr;
      continue;
    }
    PassNode& node = model.passes[step.index];
    const Index rendering = model.input->plan.passes[step.index].rendering;
    if (rendering == kNone) {
      open = nullptr;
      continue;
    }
    node.first_in_rendering = !open || model.input->plan.passes[open->plan_pass].rendering != rendering;
    if (!node.first_in_rendering) model.passes[open->plan_pass].last_in_rendering = false;
    node.rendering = node.first_in_rendering ? ++next : next;
    open = &node;
  }
}

void number_orders(Model& model) {
  std::vector<uint32_t> by_program(model.input->graph.passes.size(), kNone);
  for (const PassNode& node : model.passes) by_program[node.program_pass] = node.plan_pass;
  struct Last {
    bool atomic = false;
    uint32_t order = 0;
  };
  std::vector<Last> last(model.cell_count);
  uint32_t next = 0;
  for (const uint32_t plan_pass : by_program) {
    if (plan_pass == kNone) continue;
    const dsl::Pass& pass = model.pass(plan_pass);
    for (Use& use : model.passes[plan_pass].uses) {
      for (size_t i = 0; i < use.cells.size(); ++i) {
        Last& state = last[model.cell(use.resource, use.age % model.resources[use.resource].copies, use.cells[i])];
        const bool atomic = pass.accesses[use.access].mode == dsl::Mode::atomic;
        if (!use.commutes) {
          state = {};
          continue;
        }
        if (state.order == 0 || state.atomic != atomic) state = {atomic, ++next};
        use.orders[i] = state.order;
      }
    }
  }
}

}  // namespace rg::verify
