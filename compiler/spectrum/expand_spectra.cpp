#include "compiler/spectrum/expand_spectra.h"

#include <algorithm>
#include <functional>
#include <set>

#include "dsl/check_macro.h"

namespace rg::compiler {
namespace {

using dsl::ExprId;
using dsl::ExprOp;

constexpr dsl::Type kUint{dsl::Scalar::u32, 1, 1, {}, 0};
constexpr uint32_t kArgumentWords = 3, kWordBytes = 4;

ExprId add(dsl::Program& program, dsl::Expr expr) {
  for (size_t i = 0; i < program.exprs.size(); ++i)
    if (program.exprs.rows[i] == expr) return ExprId{i};
  return program.exprs.add(expr);
}
ExprId constant(dsl::Program& program, int64_t value) { return add(program, {ExprOp::constant, {}, {}, value}); }
ExprId combine(dsl::Program& program, ExprOp op, ExprId a, ExprId b) { return add(program, {op, a, b, 0}); }

// Groups along an axis.
ExprId groups(dsl::Program& program, const dsl::Dispatch& dispatch, size_t axis) {
  if (!dispatch.size[axis].valid()) return constant(program, 1);
  if (dispatch.kind == dsl::DispatchKind::groups) return dispatch.size[axis];
  return combine(program, ExprOp::ceil_div, dispatch.size[axis], constant(program, dispatch.group[axis]));
}

struct Parts {  // of one expanded pass
  dsl::ResourceId arguments, tiles;
  dsl::Access modes;  // the image of kernels
  ExprId width, height, area;
};

dsl::Access access_to(dsl::ResourceId resource, dsl::Mode mode, dsl::Role role, std::string name, dsl::Span span) {
  dsl::Access access;
  access.resource = resource;
  access.mode = mode;
  access.role = role;
  access.name = std::move(name);
  access.span = span;
  return access;
}

dsl::Resource resource_of(const dsl::Pass& pass, const char* suffix) {
  dsl::Resource resource;
  resource.name = pass.name + "." + suffix;
  resource.module = pass.module;
  resource.guard = pass.guard;
  resource.span = pass.span;
  return resource;
}

dsl::Resource words(dsl::Program& program, const dsl::Pass& pass, const char* suffix, ExprId count) {
  dsl::Resource buffer = resource_of(pass, suffix);
  buffer.kind = dsl::ResourceKind::buffer;
  buffer.element = kUint;
  buffer.stride = kWordBytes;
  buffer.count = count;
  (void)program;
  return buffer;
}

dsl::Access own_image_of_kernels(dsl::Graph& graph, const dsl::Pass& pass, const Parts& parts) {
  dsl::Resource modes = resource_of(pass, "modes");
  modes.format = dsl::Format::r32ui;
  modes.width = parts.width, modes.height = parts.height;
  return access_to(graph.resources.add(std::move(modes)), dsl::Mode::write, dsl::Role::storage, "modes", pass.span);
}

Parts add_resources(dsl::Program& program, dsl::Graph& graph, const dsl::Pass& pass, size_t kernels) {
  Parts parts;
  parts.width = groups(program, pass.dispatch, 0), parts.height = groups(program, pass.dispatch, 1);
  parts.area = combine(program, ExprOp::mul, parts.width, parts.height);
  const auto count = static_cast<int64_t>(kernels);
  parts.arguments = graph.resources.add(words(program, pass, "arguments", constant(program, kArgumentWords * count)));
  parts.tiles = graph.resources.add(words(program, pass, "tiles", combine(program, ExprOp::mul, parts.area, constant(program, count))));
  parts.modes = pass.kernels == dsl::kAll ? own_image_of_kernels(graph, pass, parts) : pass.accesses[pass.kernels];
  parts.modes.name = "modes";
  return parts;
}

// The queue, the conditions and the place in the order of the pass it comes from.
dsl::Pass pass_beside(const dsl::Pass& pass, std::string name, dsl::PassKind kind) {
  dsl::Pass beside;
  beside.name = std::move(name);
  beside.module = pass.module;
  beside.kind = kind;
  beside.queue = pass.queue, beside.queue_may = pass.queue_may;
  beside.guard = pass.guard;
  beside.conditions = pass.conditions;
  beside.mip_limits = pass.mip_limits;
  beside.after = pass.after;
  beside.span = pass.span;
  return beside;
}

dsl::Pass reset_pass(const dsl::Pass& pass, const Parts& parts) {
  dsl::Pass reset = pass_beside(pass, pass.name + ".reset", dsl::PassKind::transfer);
  reset.accesses.push_back(access_to(parts.arguments, dsl::Mode::write, dsl::Role::fill_dst, "arguments", pass.span));
  dsl::Transfer fill;
  fill.kind = dsl::TransferKind::fill;
  fill.dst = 0;
  fill.value.integer = true;
  reset.transfers.push_back(fill);
  return reset;
}

// The first set in order that holds a mask is the cheapest: sets ascend by cost.
std::string classify_text(const std::vector<Mask>& sets) {
  const std::string count = std::to_string(sets.size());
  std::string list;
  for (const Mask set : sets) list += (list.empty() ? "" : ", ") + std::to_string(set) + "u";
  return "const uint SETS[" + count + "] = uint[](" + list + ");\n\n" +
         "uint spectrum_mode(uint mask) {\n"
         "  for (uint mode = 0u; mode < " +
         count +
         "u - 1u; ++mode)\n"
         "    if ((mask & ~SETS[mode]) == 0u) return mode;\n"
         "  return " +
         count +
         "u - 1u;\n"
         "}\n\n"
         "void main() {\n"
         "  ivec2 grid = imageSize(modes), at = ivec2(gl_GlobalInvocationID.xy);\n"
         "  if (any(greaterThanEqual(at, grid))) return;\n"
         "  uint mode = spectrum_mode(masks[at.y * grid.x + at.x]);\n"
         "  imageStore(modes, at, uvec4(mode));\n"
         "  uint slot = atomicAdd(arguments[3u * mode], 1u);\n"
         "  tiles[mode * uint(grid.x * grid.y) + slot] = uint(at.x) | uint(at.y) << 16;\n"
         "  if (at != ivec2(0)) return;\n"
         "  for (uint i = 0u; i < " +
         count +
         "u; ++i) {\n"
         "    arguments[3u * i + 1u] = 1u;\n"
         "    arguments[3u * i + 2u] = 1u;\n"
         "  }\n"
         "}\n";
}

dsl::Pass classify_pass(dsl::Program& program, const dsl::Pass& pass, const Parts& parts, const std::vector<Mask>& sets) {
  dsl::Pass classify = pass_beside(pass, pass.name + ".classify", dsl::PassKind::compute);
  dsl::Access masks = pass.accesses[pass.masks];
  masks.name = "masks";
  classify.accesses.push_back(std::move(masks));
  classify.accesses.push_back(access_to(parts.arguments, dsl::Mode::update, dsl::Role::storage, "arguments", pass.span));
  classify.accesses.push_back(access_to(parts.tiles, dsl::Mode::write, dsl::Role::storage, "tiles", pass.span));
  classify.accesses.push_back(parts.modes);
  classify.shaders.push_back({dsl::stage_compute, "rgc/" + pass.name + "_classify.comp", pass.span, classify_text(sets)});
  classify.dispatch.kind = dsl::DispatchKind::over;
  classify.dispatch.size[0] = parts.width, classify.dispatch.size[1] = parts.height, classify.dispatch.size[2] = constant(program, 1);
  classify.dispatch.group[0] = classify.dispatch.group[1] = 8;
  return classify;
}

void add_features(const dsl::Spectrum& spectrum, const std::vector<Mask>& sets, size_t kernel, dsl::Pass& pass) {
  const auto number = [&](const char* name, size_t value) {
    pass.features.push_back({name, {}, static_cast<uint32_t>(value), {"first"}, pass.span});
  };
  number("rg_mode", kernel);
  number("rg_modes", sets.size());
  for (size_t i = 0; i < spectrum.members.size(); ++i)
    pass.features.push_back({spectrum.members[i].name, {}, sets[kernel] >> i & 1, {}, spectrum.members[i].span});
}

dsl::Pass kernel_pass(dsl::Program& program, const dsl::Pass& pass, const Parts& parts, const KernelSets& kernels, size_t kernel) {
  const std::vector<Mask>& sets = kernels.sets;
  dsl::Pass row = pass;
  if (!kernels.shares.empty()) row.work_share = kernels.shares[kernel];
  row.name = kernel_name(pass.name, kernel);
  const std::set<uint32_t, std::greater<>> of_classifier = {pass.masks, pass.kernels == dsl::kAll ? pass.masks : pass.kernels};
  for (const uint32_t access : of_classifier) row.accesses.erase(row.accesses.begin() + access);
  row.masks = row.kernels = dsl::kAll;
  row.accesses.push_back(access_to(parts.tiles, dsl::Mode::read, dsl::Role::storage, "rg_tiles", pass.span));
  dsl::Access arguments = access_to(parts.arguments, dsl::Mode::read, dsl::Role::indirect, "rg_arguments", pass.span);
  const auto bytes = static_cast<int64_t>(kArgumentWords) * kWordBytes;
  arguments.range.offset = constant(program, bytes * static_cast<int64_t>(kernel));
  arguments.range.size = constant(program, bytes);
  row.dispatch.kind = dsl::DispatchKind::indirect;
  row.dispatch.arguments = static_cast<uint32_t>(row.accesses.size());
  row.dispatch.size[0] = row.dispatch.size[1] = row.dispatch.size[2] = {};
  row.accesses.push_back(std::move(arguments));
  add_features(program.spectra[pass.spectrum], sets, kernel, row);
  row.spectrum = {};
  row.interface_lines.push_back(
      "uvec2 spectrum_tile() { uint rg_at = rg_tiles[rg_mode * (uint(rg_tiles.length()) / rg_modes) + gl_WorkGroupID.x]; "
      "return uvec2(rg_at & 0xFFFFu, rg_at >> 16); }");
  row.interface_lines.push_back("uvec2 spectrum_pixel() { return spectrum_tile() * gl_WorkGroupSize.xy + gl_LocalInvocationID.xy; }");
  return row;
}

// The passes that run one pass, in order.
std::vector<dsl::Pass> expand(dsl::Program& program, dsl::Graph& graph, const dsl::Pass& pass, const KernelSets& kernels) {
  const Parts parts = add_resources(program, graph, pass, kernels.sets.size());
  std::vector<dsl::Pass> passes = {reset_pass(pass, parts), classify_pass(program, pass, parts, kernels.sets)};
  for (size_t k = 0; k < kernels.sets.size(); ++k) passes.push_back(kernel_pass(program, pass, parts, kernels, k));
  return passes;
}

const KernelSets* kernels_of(const dsl::Pass& pass, const std::vector<KernelSets>& kernels) {
  for (const KernelSets& row : kernels)
    if (pass.spectrum.valid() && row.spectrum == pass.spectrum) return &row;
  return nullptr;
}

// What ran after a pass runs after the last of those it became.
void renumber(dsl::Graph& graph, const std::vector<size_t>& last) {
  for (dsl::Pass& pass : graph.passes)
    for (dsl::PassId& other : pass.after) other = dsl::PassId{last[other.value]};
  for (dsl::Params& params : graph.params)
    if (params.pass.valid()) params.pass = dsl::PassId{last[params.pass.value]};
}

void expand_graph(dsl::Program& program, dsl::Graph& graph, const std::vector<KernelSets>& kernels) {
  std::vector<dsl::Pass> passes = std::move(graph.passes.rows);
  graph.passes.rows.clear();
  std::vector<size_t> last;
  for (dsl::Pass& pass : passes) {
    const KernelSets* row = kernels_of(pass, kernels);
    if (row == nullptr) {
      graph.passes.add(std::move(pass));
    } else {
      RG_CHECK(!row->sets.empty(), "a spectrum has at least the kernel of all its features");
      for (dsl::Pass& each : expand(program, graph, pass, *row)) graph.passes.add(std::move(each));
    }
    last.push_back(graph.passes.size() - 1);
  }
  renumber(graph, last);
}

}  // namespace

std::string kernel_name(const std::string& pass, size_t kernel) { return pass + "[" + std::to_string(kernel) + "]"; }

dsl::Program expand_spectra(dsl::Program program, const std::vector<KernelSets>& kernels) {
  for (size_t g = 0; g < program.graphs.size(); ++g) {
    dsl::Graph graph = std::move(program.graphs.rows[g]);
    expand_graph(program, graph, kernels);
    program.graphs.rows[g] = std::move(graph);
  }
  for (const KernelSets& row : kernels) program.spectra[row.spectrum].kernels = row.sets;
  return program;
}

}  // namespace rg::compiler
