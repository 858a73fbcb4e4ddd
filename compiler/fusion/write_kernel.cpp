#include "compiler/fusion/write_kernel.h"

#include <algorithm>
#include <optional>

#include "compiler/shaders/glsl_types.h"
#include "compiler/shaders/interface.h"
#include "dsl/format_table.h"

namespace rg::compiler {
namespace {

using dsl::Mode;
using dsl::ResourceKind;
using dsl::Role;

constexpr uint32_t kOrderedLanes = 4;  // up to as many are joined one after the other: as few steps as a tree, and the order of a walk

// ---- what the kernel holds

struct Cell {          // an element's value, in a variable
  dsl::Access access;  // merged over the members
  std::string name;    // of the variable
  bool load = false, store = false, dropped = false;
  size_t last_read = 0;  // the last member that reads it
};

struct Parts {
  dsl::Program& program;
  const dsl::Graph& graph;
  const KernelOrder& order;
  std::vector<const dsl::Pass*> members;
  std::vector<Cell> cells;
  std::vector<std::vector<size_t>> cell_of;                 // [member][access], SIZE_MAX: no element
  std::vector<std::map<std::string, std::string>> renamed;  // by member: names of its source -> names of the kernel
  std::set<std::string> taken;
  dsl::Pass pass;
};

const dsl::Pass& first(const Parts& at) { return *at.members.front(); }
const dsl::Resource& resource_of(const Parts& at, const dsl::Access& access) { return at.graph.resources[access.resource]; }

std::string claim(Parts& at, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; !at.taken.insert(name).second; ++i) name = wanted + "_" + std::to_string(i);
  return name;
}

void note_name(Parts& at, size_t member, const std::string& own, const std::string& kernel) {
  if (own != kernel) at.renamed[member][own] = kernel;
}

void use_cell(Cell& cell, const dsl::Access& access, size_t member) {
  const bool reads = access.mode != Mode::write, writes = access.mode != Mode::read;
  cell.load |= reads && !cell.store;
  cell.store |= writes;
  cell.access.disjoint |= access.disjoint;
  if (reads) cell.last_read = member;
}

void add_cell(Parts& at, size_t member, size_t index, const dsl::Access& access) {
  size_t i = 0;
  while (i < at.cells.size() && !same_cell(at.cells[i].access, access)) ++i;
  if (i == at.cells.size()) {
    Cell cell;
    cell.access = access;
    cell.access.disjoint = false;
    cell.access.name = claim(at, access.name);
    cell.name = (at.members.size() == 1 ? "" : "rg_") + cell.access.name;  // no block sees a variable of another
    at.cells.push_back(std::move(cell));
  }
  use_cell(at.cells[i], access, member);
  note_name(at, member, access.name, at.cells[i].name);
  at.cell_of[member][index] = i;
}

bool same_plain(const dsl::Access& a, const dsl::Access& b) {
  return !a.element && a.resource == b.resource && a.range == b.range && a.age == b.age && a.role == b.role && a.mode == b.mode &&
         a.sampler == b.sampler && a.view == b.view && (a.mode == Mode::read || a.mode == Mode::atomic);
}

void add_plain(Parts& at, size_t member, const dsl::Access& access) {
  for (const dsl::Access& other : at.pass.accesses)
    if (same_plain(other, access)) return note_name(at, member, access.name, other.name);
  dsl::Access added = access;
  added.name = claim(at, access.name);
  note_name(at, member, access.name, added.name);
  at.pass.accesses.push_back(std::move(added));
}

void collect_accesses(Parts& at) {
  for (size_t m = 0; m < at.members.size(); ++m) {
    const std::vector<dsl::Access>& accesses = at.members[m]->accesses;
    at.cell_of.emplace_back(accesses.size(), SIZE_MAX);
    for (size_t i = 0; i < accesses.size(); ++i)
      if (accesses[i].element)
        add_cell(at, m, i, accesses[i]);
      else
        add_plain(at, m, accesses[i]);
  }
  for (Cell& cell : at.cells) {
    cell.dropped = !cell.load && cell.store && at.order.dropped.contains(cell.access.resource);
    cell.access.mode = !cell.store ? Mode::read : cell.load ? Mode::update : Mode::write;
    const bool fetched = !cell.store && resource_of(at, cell.access).kind == ResourceKind::image;
    cell.access.role = fetched ? Role::sampled : Role::storage;
    if (!cell.dropped) at.pass.accesses.push_back(cell.access);
  }
}

template <class T, class Same>
void add_once(std::vector<T>& all, const std::vector<T>& more, Same same) {
  for (const T& each : more)
    if (std::none_of(all.begin(), all.end(), [&](const T& other) { return same(other, each); })) all.push_back(each);
}

// Two techniques may call different parameters the same, or the same ones differently.
void add_params(Parts& at, size_t member) {
  for (dsl::ParamsUse use : at.members[member]->params) {
    const std::string own = use.name;
    const auto same = std::find_if(at.pass.params.begin(), at.pass.params.end(), [&](const dsl::ParamsUse& other) { return other.id == use.id; });
    use.name = same != at.pass.params.end() ? same->name : claim(at, own);
    note_name(at, member, own, use.name);
    if (same == at.pass.params.end()) at.pass.params.push_back(std::move(use));
  }
}

void collect_blocks(Parts& at) {
  for (size_t m = 0; m < at.members.size(); ++m) {
    const dsl::Pass& member = *at.members[m];
    add_once(at.pass.features, member.features, [](const dsl::ShaderFeature& a, const dsl::ShaderFeature& b) { return a.name == b.name; });
    add_once(at.pass.conditions, member.conditions, [](dsl::ConditionId a, dsl::ConditionId b) { return a == b; });
    add_once(at.pass.after, member.after, [](dsl::PassId a, dsl::PassId b) { return a == b; });
    at.pass.keep |= member.keep;
    if (at.pass.bind.empty()) at.pass.bind = member.bind;
  }
  for (const KernelMember& member : at.order.members)
    at.pass.after.erase(std::remove(at.pass.after.begin(), at.pass.after.end(), member.pass), at.pass.after.end());
  for (const dsl::ShaderFeature& feature : at.pass.features) at.taken.insert(feature.name);
  for (size_t m = 0; m < at.members.size(); ++m) add_params(at, m);
}

// ---- GLSL of places and values

std::string axes_text(const std::string& vector, uint32_t axes) {
  if (axes == 1) return vector + ".x";
  return axes == 2 ? vector + ".xy" : vector;
}

uint32_t image_axes(const dsl::Resource& image) { return image.dimension == dsl::Dimension::d1 ? 1 : image.dimension == dsl::Dimension::d3 ? 3 : 2; }

bool is_struct(const dsl::Resource& resource) { return resource.kind == ResourceKind::buffer && resource.format == dsl::Format::none; }

std::string cell_type(const Parts& at, const Cell& cell) {
  const dsl::Resource& resource = resource_of(at, cell.access);
  if (is_struct(resource)) return glsl_type(at.program, resource.element);
  const uint32_t aspects = resource.kind == ResourceKind::image ? view_shape(resource, cell.access).aspects : dsl::aspect_color;
  return texel_type(dsl::seen_format(resource, cell.access), aspects);
}

std::string place_of(const Parts& at, const dsl::Access& access) {
  const dsl::Resource& resource = resource_of(at, access);
  if (resource.kind == ResourceKind::buffer) return "rg_index(rg_at)";
  return axes_text("rg_at", image_axes(resource));
}

std::string load_text(const Parts& at, const Cell& cell) {
  const dsl::Resource& resource = resource_of(at, cell.access);
  const std::string binding = binding_name(cell.access), place = place_of(at, cell.access);
  if (is_struct(resource)) return cell.name + " = " + binding + "[" + place + "];";
  const bool fetched = cell.access.role == Role::sampled;
  const std::string texel = fetched ? "texelFetch(" + binding + ", " + place + ", 0)" : "imageLoad(" + binding + ", " + place + ")";
  constexpr const char* kParts[] = {"", ".x", ".xy", ".xyz", ""};
  return cell.name + " = " + texel + kParts[components(dsl::seen_format(resource, cell.access))] + ";";
}

std::string store_text(const Parts& at, const Cell& cell) {
  const dsl::Resource& resource = resource_of(at, cell.access);
  const std::string binding = binding_name(cell.access), place = place_of(at, cell.access);
  if (is_struct(resource)) return binding + "[" + place + "] = " + cell.name + ";";
  const std::string type = cell_type(at, cell), prefix = type[0] == 'u' ? "u" : type[0] == 'i' ? "i" : "";
  constexpr const char* kRest[] = {"", ", 0, 0, 1", ", 0, 1", ", 1", ""};
  const char* rest = kRest[components(dsl::seen_format(resource, cell.access))];
  return "imageStore(" + binding + ", " + place + ", " + prefix + "vec4(" + cell.name + rest + "));";
}

std::string zero_text(const Parts& at, const Cell& cell) {
  const dsl::Resource& resource = resource_of(at, cell.access);
  const bool record = is_struct(resource) && resource.element.record.valid();
  return record ? "" : cell.name + " = " + cell_type(at, cell) + "(0);";
}

// ---- the domain

// GLSL of its size: constants, or that of an image of the kernel.
std::string domain_text(const Parts& at) {
  const dsl::ExprId* size = first(at).dispatch.size;
  std::string text;
  bool constant = true;
  for (int axis = 0; axis < 3; ++axis) {
    const dsl::Expr& expr = at.program.exprs[size[axis]];
    constant = constant && expr.op == dsl::ExprOp::constant;
    text += (axis == 0 ? "" : ", ") + std::to_string(expr.value);
  }
  if (constant) return "ivec3(" + text + ")";
  for (const Cell& cell : at.cells) {
    const dsl::Resource& image = resource_of(at, cell.access);
    if (cell.dropped || image.kind != ResourceKind::image) continue;
    const std::string binding = binding_name(cell.access);
    const std::string extent = cell.access.role == Role::sampled ? "textureSize(" + binding + ", 0)" : "imageSize(" + binding + ")";
    constexpr const char* kRest[] = {"", ", 1, 1", ", 1", ""};
    return "ivec3(" + extent + kRest[image_axes(image)] + ")";
  }
  return "ivec3(1)";
}

std::string at_type(uint32_t axes) { return axes == 1 ? "int" : "ivec" + std::to_string(axes); }

bool any_buffer(const Parts& at) {
  return std::any_of(at.cells.begin(), at.cells.end(),
                     [&](const Cell& cell) { return !cell.dropped && resource_of(at, cell.access).kind == ResourceKind::buffer; });
}

void add_interface(Parts& at) {
  std::vector<std::string>& lines = at.pass.interface_lines;
  const uint32_t axes = first(at).block->axes;
  lines.push_back("ivec3 rg_domain() { return " + domain_text(at) + "; }");
  lines.push_back(at_type(axes) + " domain_size() { return " + axes_text("rg_domain()", axes) + "; }");
  if (any_buffer(at)) lines.push_back("int rg_index(ivec3 at) { ivec3 end = rg_domain(); return (at.z * end.y + at.y) * end.x + at.x; }");
  for (const Cell& cell : at.cells) lines.push_back(cell_type(at, cell) + " " + cell.name + ";");
}

// ---- the body

struct Body {
  Parts& at;
  std::string text;
  std::string place;  // of the element, as an argument
  size_t indent = 1;

  void line(const std::string& code) {
    if (!code.empty()) text += std::string(2 * indent, ' ') + code + "\n";
  }
};

std::string number(size_t member) { return std::to_string(member); }

// The name by which the kernel calls a function of a member's block.
std::string function(const Parts& at, size_t member, const char* name) {
  return at.members.size() == 1 ? name : name + std::string("_rg") + number(member);
}

std::string carry_type(const Parts& at, size_t member) { return glsl_type(at.program, at.members[member]->block->carry); }

bool scans(const dsl::Pass& pass) { return pass.block->scan != dsl::kAll; }

std::optional<uint32_t> scan_axis(const std::vector<const dsl::Pass*>& members) {
  for (const dsl::Pass* member : members)
    if (scans(*member)) return member->block->scan;
  return std::nullopt;
}

void begin_element(Body& body) {
  for (const Cell& cell : body.at.cells) body.line(cell.load ? load_text(body.at, cell) : zero_text(body.at, cell));
}

// What a later member reads, as it would have come back from memory.
void convert(Body& body, size_t member) {
  const dsl::Pass& pass = *body.at.members[member];
  for (size_t i = 0; i < pass.accesses.size(); ++i) {
    const size_t index = body.at.cell_of[member][i];
    if (index == SIZE_MAX || pass.accesses[i].mode == Mode::read) continue;
    const Cell& cell = body.at.cells[index];
    const dsl::Resource& resource = resource_of(body.at, cell.access);
    if (cell.last_read <= member || is_struct(resource) || (cell.dropped && body.at.order.unrounded)) continue;
    body.line(conversion_call(dsl::seen_format(resource, cell.access), cell.name));
  }
}

void run_member(Body& body, size_t member, const std::string& carried) {
  body.line(function(body.at, member, "element") + "(" + body.place + (carried.empty() ? "" : ", " + carried) + ");");
  convert(body, member);
}

void end_element(Body& body) {
  for (const Cell& cell : body.at.cells)
    if (cell.store && !cell.dropped) body.line(store_text(body.at, cell));
}

std::string carried(size_t member) { return "rg_carried" + number(member); }

void begin_line(Body& body) {
  for (size_t m = 0; m < body.at.members.size(); ++m)
    if (scans(*body.at.members[m]))
      body.line(carry_type(body.at, m) + " " + carried(m) + " = " + function(body.at, m, "start") + "(" + body.place + ");");
}

void main_of_elements(Body& body) {
  body.line("ivec3 rg_at = ivec3(gl_GlobalInvocationID);");
  body.line("if (any(greaterThanEqual(rg_at, rg_domain()))) return;");
  begin_element(body);
  for (size_t m = 0; m < body.at.members.size(); ++m) run_member(body, m, "");
  end_element(body);
}

// One invocation walks a line.
void main_of_walk(Body& body, uint32_t axis) {
  const std::string along = std::string("rg_at.") + "xyz"[axis];
  body.line("ivec3 rg_at = ivec3(gl_GlobalInvocationID), rg_end = rg_domain();");
  body.line(along + " = 0;");
  body.line("if (any(greaterThanEqual(rg_at, rg_end))) return;");
  begin_line(body);
  body.line("for (; " + along + " < rg_end." + "xyz"[axis] + "; ++" + along + ") {");
  ++body.indent;
  begin_element(body);
  for (size_t m = 0; m < body.at.members.size(); ++m) {
    const bool joins = body.at.members[m]->block->associative;
    if (joins)
      body.line(carried(m) + " = " + function(body.at, m, "join") + "(" + carried(m) + ", " + function(body.at, m, "own") + "(" + body.place + "));");
    run_member(body, m, scans(*body.at.members[m]) ? carried(m) : "");
  }
  end_element(body);
  --body.indent;
  body.line("}");
}

// What stands in front of each lane: one lane after the other, or by doubling distances (Hillis and Steele 1986) where there are many.
void join_lanes(Body& body, size_t member, uint32_t lanes, uint32_t stride) {
  const std::string type = carry_type(body.at, member), line = "rg_line" + number(member), join = function(body.at, member, "join"),
                    sum = "rg_sum" + number(member), next = carried(member), apart = " * " + std::to_string(stride) + "u";
  body.line("barrier();");
  if (lanes <= kOrderedLanes) {
    body.line(type + " " + sum + " = " + next + ";");
    body.line("for (uint rg_i = 0u; rg_i < rg_count; ++rg_i) {");
    body.line("  " + next + " = " + join + "(" + next + ", " + line + "[rg_first + rg_i" + apart + "]);");
    body.line("  if (rg_i == rg_lane) " + sum + " = " + next + ";");
    body.line("}");
    return body.line("barrier();");
  }
  body.line(type + " " + sum + " = " + line + "[gl_LocalInvocationIndex];");
  body.line("for (uint rg_away = 1u; rg_away < " + std::to_string(lanes) + "u; rg_away <<= 1) {");
  const std::string before = line + "[gl_LocalInvocationIndex - rg_away" + apart + "]";
  body.line("  if (rg_lane >= rg_away && rg_here) " + sum + " = " + join + "(" + before + ", " + sum + ");");
  body.line("  barrier();");
  body.line("  " + line + "[gl_LocalInvocationIndex] = " + sum + ";");
  body.line("  barrier();");
  body.line("}");
  body.line(sum + " = " + join + "(" + next + ", " + sum + ");");
  body.line(next + " = " + join + "(" + next + ", " + line + "[rg_first + (rg_count - 1u)" + apart + "]);");
  body.line("barrier();");
}

// The lanes of a group that lie along the axis hold as many elements of the line, step by step.
void main_of_scan(Body& body, uint32_t axis, const GroupShape& group) {
  const std::string letter(1, "xyz"[axis]), lanes = std::to_string(group.size[axis]);
  uint32_t stride = 1;
  for (uint32_t before = 0; before < axis; ++before) stride *= group.size[before];
  body.line("ivec3 rg_at = ivec3(gl_GlobalInvocationID), rg_end = rg_domain();");
  body.line("uint rg_lane = gl_LocalInvocationID." + letter + ", rg_first = gl_LocalInvocationIndex - rg_lane * " + std::to_string(stride) + "u;");
  body.line("rg_at." + letter + " = 0;");
  body.line("bool rg_inside = all(lessThan(rg_at, rg_end));");
  begin_line(body);
  body.line("for (int rg_base = 0; rg_base < rg_end." + letter + "; rg_base += " + lanes + ") {");
  ++body.indent;
  body.line("rg_at." + letter + " = rg_base + int(rg_lane);");
  body.line("bool rg_here = rg_inside && rg_at." + letter + " < rg_end." + letter + ";");
  body.line("uint rg_count = uint(min(" + lanes + ", rg_end." + letter + " - rg_base));");
  body.line("if (rg_here) {");
  ++body.indent;
  begin_element(body);
  for (size_t m = 0; m < body.at.members.size(); ++m) {
    if (!scans(*body.at.members[m])) {
      run_member(body, m, "");
      continue;
    }
    body.line("rg_line" + number(m) + "[gl_LocalInvocationIndex] = " + function(body.at, m, "own") + "(" + body.place + ");");
    --body.indent;
    body.line("}");
    join_lanes(body, m, group.size[axis], stride);
    body.line("if (rg_here) {");
    ++body.indent;
    run_member(body, m, "rg_sum" + number(m));
  }
  end_element(body);
  --body.indent;
  body.line("}");
  --body.indent;
  body.line("}");
}

std::string main_text(Parts& at, const GroupShape& group) {
  Body body{at, "", axes_text("rg_at", first(at).block->axes)};
  const auto axis = scan_axis(at.members);
  const std::string lanes = std::to_string(group.size[0] * group.size[1] * group.size[2]);
  std::string shared;
  if (axis && group.size[*axis] > 1)
    for (size_t m = 0; m < at.members.size(); ++m)
      if (scans(*at.members[m])) shared += "shared " + carry_type(at, m) + " rg_line" + number(m) + "[" + lanes + "];\n";
  if (!axis)
    main_of_elements(body);
  else if (group.size[*axis] == 1)
    main_of_walk(body, *axis);
  else
    main_of_scan(body, *axis, group);
  return shared + "\nvoid main() {\n" + body.text + "}\n";
}

// ---- the whole text

std::string conversions(const Parts& at) {
  if (at.members.size() == 1) return "";
  std::set<dsl::Format> formats;
  for (const Cell& cell : at.cells)
    if (cell.store && !is_struct(resource_of(at, cell.access))) formats.insert(dsl::seen_format(resource_of(at, cell.access), cell.access));
  std::string text;
  for (const dsl::Format format : formats) text += conversion_text(format, at.order.halves);
  return text;
}

// Names of a block's source that another might have too get the number of the member behind them.
std::string member_text(Parts& at, size_t member) {
  const FlatSource& source = at.order.members[member].source;
  std::map<std::string, std::string> renamed = at.renamed[member];
  for (const std::string& name : global_names(glsl_words(source.text))) renamed.try_emplace(name, name + "_rg" + number(member));
  return rename(source.text, renamed);
}

std::string shader_text(Parts& at, const GroupShape& group) {
  std::string text = "// " + at.pass.name + ", from";
  for (const dsl::Pass* member : at.members) text += " " + member->shaders[0].path;
  text += "\n" + conversions(at);
  if (at.members.size() == 1) return text + "#include \"" + first(at).shaders[0].path + "\"\n" + main_text(at, group);
  for (size_t m = 0; m < at.members.size(); ++m) text += member_text(at, m);
  return text + "#line 1 \"rgc/" + at.pass.name + ".comp\"\n" + main_text(at, group);
}

dsl::ExprId constant(dsl::Program& program, int64_t value) {
  const dsl::Expr expr{dsl::ExprOp::constant, {}, {}, value};
  for (size_t i = 0; i < program.exprs.size(); ++i)
    if (program.exprs.rows[i] == expr) return dsl::ExprId{i};
  return program.exprs.add(expr);
}

}  // namespace

bool same_cell(const dsl::Access& a, const dsl::Access& b) {
  return a.element && b.element && a.resource == b.resource && a.range == b.range && a.age == b.age && a.view == b.view;
}

// That of the first block that says one, else that of the block that scans; lanes along a line only if every scan may be summed up in pieces.
GroupShape group_of(const std::vector<const dsl::Pass*>& members) {
  const auto axis = scan_axis(members);
  const auto find = [&](auto wanted) { return std::find_if(members.begin(), members.end(), [&](const dsl::Pass* pass) { return wanted(*pass); }); };
  auto chosen = find([](const dsl::Pass& pass) { return pass.block->sized && scans(pass); });
  if (chosen == members.end()) chosen = find([](const dsl::Pass& pass) { return pass.block->sized; });
  if (chosen == members.end()) chosen = find([](const dsl::Pass& pass) { return scans(pass); });
  if (chosen == members.end()) chosen = members.begin();
  GroupShape shape;
  std::copy_n((*chosen)->dispatch.group, 3, shape.size);
  const bool walks = std::any_of(members.begin(), members.end(), [](const dsl::Pass* pass) { return scans(*pass) && !pass->block->associative; });
  if (axis && walks) shape.size[*axis] = 1;
  return shape;
}

uint64_t shared_bytes(const dsl::Program& program, const std::vector<const dsl::Pass*>& members) {
  const auto axis = scan_axis(members);
  const GroupShape group = group_of(members);
  if (!axis || group.size[*axis] == 1) return 0;
  uint64_t bytes = 0;
  for (const dsl::Pass* member : members) {
    if (!scans(*member)) continue;
    const dsl::Type& type = member->block->carry;
    const uint64_t each = type.record.valid() ? program.structs[type.record].size430 : uint64_t{type.columns} * (type.rows == 3 ? 4 : type.rows) * 4;
    bytes += each * group.size[0] * group.size[1] * group.size[2];
  }
  return bytes;
}

dsl::Pass write_kernel(dsl::Program& program, const dsl::Graph& graph, const KernelOrder& order) {
  Parts at{program, graph, order, {}, {}, {}, {}, {}, {}};
  for (const KernelMember& member : order.members) at.members.push_back(&graph.passes[member.pass]);
  at.renamed.resize(at.members.size());
  at.pass = first(at);
  at.pass.name = order.name;
  at.pass.accesses.clear(), at.pass.params.clear();
  collect_blocks(at);
  collect_accesses(at);
  add_interface(at);
  const GroupShape group = group_of(at.members);
  std::copy_n(group.size, 3, at.pass.dispatch.group);
  if (const auto axis = scan_axis(at.members)) at.pass.dispatch.size[*axis] = constant(program, group.size[*axis]);
  dsl::Shader shader = first(at).shaders[0];
  shader.path = "rgc/" + order.name + ".comp";
  shader.text = shader_text(at, group);
  at.pass.shaders = {std::move(shader)};
  at.pass.block.reset();
  at.pass.fusion = {};
  return std::move(at.pass);
}

}  // namespace rg::compiler
