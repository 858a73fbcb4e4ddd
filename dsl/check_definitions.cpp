// Every read needs a write that reaches it on every path: in every feature configuration and whatever the host's conditions are.
//
// A resource is a set of cells: (aspect, mip, layer) of an image, with slices for layers in a volume of known depth; the whole or byte ranges of a
// buffer. A cell remembers under which guards and conditions it has been written for certain. A pass that touches mip m of an image runs only at
// extents where the image has that mip: what it writes is certain for readers that need the same mip, and for the mips that vanish with it.
#include <algorithm>
#include <set>

#include "dsl/check_state.h"
#include "dsl/features.h"
#include "dsl/symbolic.h"

namespace rg::dsl {
namespace {

struct Fact {  // written for certain whenever the guard, the conditions and the limits hold
  Guard guard;
  std::vector<ConditionId> conditions;
  std::vector<MipLimit> limits;
  friend bool operator==(const Fact&, const Fact&) = default;
  bool always() const { return guard.terms.empty() && conditions.empty() && limits.empty(); }
};
struct Cell {
  bool always = false;
  std::vector<Fact> facts;
};
struct ByteRange {
  Polynomial begin, end;
  Fact fact;
};
struct Tracked {
  Cell whole;               // buffers, and images written as a whole
  std::vector<Cell> cells;  // images: aspect-major, allocated on the first partial write
  std::vector<ByteRange> bytes;
  std::vector<uint32_t> may;  // passes that may have written
};

struct Walk {
  Checker& checker;
  const Graph& graph;
  std::vector<Tracked> tracked;
  std::vector<bool> reported;  // by resource: its first bad read is enough
  std::vector<bool> written;   // by resource: some pass writes it, perhaps
  mutable Formulas formulas;
};

bool implies(const std::vector<ConditionId>& reader, const std::vector<ConditionId>& writer) {
  return std::all_of(writer.begin(), writer.end(), [&](ConditionId each) { return std::find(reader.begin(), reader.end(), each) != reader.end(); });
}

bool implies(const std::vector<MipLimit>& reader, const std::vector<MipLimit>& writer) {
  return std::all_of(writer.begin(), writer.end(), [&](const MipLimit& limit) {
    return std::any_of(reader.begin(), reader.end(), [&](const MipLimit& held) { return held.image == limit.image && held.mip >= limit.mip; });
  });
}

// Tries every feasible configuration of the features that matter; where they are too many only unconditional facts count.
bool every_configuration(const Walk& walk, const std::vector<bool>& matters, const Guard& reader, const std::vector<const Fact*>& facts) {
  constexpr uint64_t kBudget = 16384;
  const auto& features = walk.checker.program.features;
  const FeatureValues free(features.size(), kFreeFeature);
  return each_configuration(features, free, matters, kBudget, [&](const FeatureValues& values) {
    return !holds(reader, values) || std::any_of(facts.begin(), facts.end(), [&](const Fact* fact) { return holds(fact->guard, values); });
  });
}

bool covers(const Walk& walk, const std::vector<const Fact*>& facts, const Fact& reader) {
  std::vector<const Fact*> usable;
  std::vector<bool> matters(walk.checker.program.features.size(), false);
  const auto mention = [&](const Guard& guard) {
    for (const Guard::Term& term : guard.terms) matters[term.feature.value] = true;
  };
  for (const Fact* fact : facts) {
    if (!implies(reader.conditions, fact->conditions) || !implies(reader.limits, fact->limits)) continue;
    if (fact->guard.terms.empty() || fact->guard == reader.guard) return true;
    usable.push_back(fact);
    mention(fact->guard);
  }
  if (usable.empty()) return false;
  mention(reader.guard);
  return every_configuration(walk, matters, reader.guard, usable);
}

void add_facts(const Cell& cell, std::vector<const Fact*>& facts) {
  for (const Fact& fact : cell.facts) facts.push_back(&fact);
}

bool cell_defined(const Walk& walk, const Tracked& tracked, const Cell* cell, const Fact& reader) {
  if (tracked.whole.always || (cell && cell->always)) return true;
  std::vector<const Fact*> facts;
  add_facts(tracked.whole, facts);
  if (cell) add_facts(*cell, facts);
  return covers(walk, facts, reader);
}

void set(Cell& cell, const Fact& fact) {
  if (cell.always) return;
  if (fact.always()) {
    cell.always = true;
    cell.facts.clear();
  } else if (std::find(cell.facts.begin(), cell.facts.end(), fact) == cell.facts.end()) {
    cell.facts.push_back(fact);
  }
}

// ---- images -----------------------------------------------------------------------------------------------------

constexpr uint32_t kAspects[] = {aspect_color, aspect_depth, aspect_stencil};

bool is_known(const Walk& walk, ExprId id) { return id.valid() && walk.checker.program.exprs[id].op == ExprOp::constant; }

// Cells of each aspect and mip: layers, or the slices of a volume whose depth is known.
struct Row {
  uint32_t width = 1;
  bool of_slices = false;
};
Row row_of(const Walk& walk, const Resource& image) {
  constexpr int64_t kMostSlices = 2048;
  if (image.dimension != Dimension::d3 || !is_known(walk, image.depth) || walk.checker.program.exprs[image.depth].value > kMostSlices)
    return {image.layers, false};
  return {static_cast<uint32_t>(walk.checker.program.exprs[image.depth].value), true};
}

bool is_whole(const Resource& image, const Range& range) {
  if (range.slices != kAll) return false;
  return range.aspects == info(image.format).aspects && mip_count(image, range) == image.mips && layer_count(image, range) == image.layers;
}

// Calls visit(cell index) for every cell of the range; stops when it returns false.
template <class Visit>
bool each_cell(const Row& row, const Resource& image, const Range& range, Visit visit) {
  for (uint32_t aspect = 0; aspect < 3; ++aspect) {
    if ((range.aspects & kAspects[aspect]) == 0) continue;
    for (uint32_t mip = range.mip; mip < range.mip + mip_count(image, range); ++mip) {
      const bool some = row.of_slices && range.slices != kAll;
      const uint32_t first = some ? range.slice : range.layer;
      const uint32_t count = some ? range.slices : row.of_slices ? std::max(row.width >> mip, 1u) : layer_count(image, range);
      for (uint32_t at = first; at < first + count; ++at)
        if (!visit((aspect * image.mips + mip) * row.width + at)) return false;
    }
  }
  return true;
}

uint32_t mip_of_cell(const Row& row, const Resource& image, uint32_t cell) { return cell / row.width % image.mips; }

// Where the cell exists, limits to its own image up to its own mip hold.
Fact for_cell(Fact fact, ResourceId id, uint32_t mip) {
  std::erase_if(fact.limits, [&](const MipLimit& limit) { return limit.image == id && limit.mip <= mip; });
  return fact;
}

void define_image(const Walk& walk, Tracked& tracked, ResourceId id, const Resource& image, const Range& range, const Fact& fact) {
  if (is_whole(image, range) && fact.limits.empty()) return set(tracked.whole, fact);
  const Row row = row_of(walk, image);
  if (range.slices != kAll && !row.of_slices) return;  // nobody knows how many there are
  if (tracked.cells.empty()) tracked.cells.resize(size_t{3} * image.mips * row.width);
  each_cell(row, image, range, [&](uint32_t cell) { return set(tracked.cells[cell], for_cell(fact, id, mip_of_cell(row, image, cell))), true; });
}

bool image_defined(const Walk& walk, const Tracked& tracked, const Resource& image, const Range& range, const Fact& reader) {
  if (tracked.cells.empty()) return cell_defined(walk, tracked, nullptr, reader);
  return each_cell(row_of(walk, image), image, range, [&](uint32_t cell) { return cell_defined(walk, tracked, &tracked.cells[cell], reader); });
}

// ---- buffers ----------------------------------------------------------------------------------------------------

ByteRange bytes_of(const Walk& walk, const Resource& buffer, const Range& range, const Fact& fact) {
  if (!range.offset.valid()) return {Polynomial(0), walk.formulas.of(buffer.count) * Polynomial(buffer.stride), fact};
  const Polynomial begin = walk.formulas.of(range.offset);
  return {begin, begin + walk.formulas.of(range.size), fact};
}

void define_buffer(const Walk& walk, Tracked& tracked, const Resource& buffer, const Range& range, const Fact& fact) {
  if (!range.offset.valid()) return set(tracked.whole, fact);
  tracked.bytes.push_back(bytes_of(walk, buffer, range, fact));
}

bool reaches(const Walk& walk, const Polynomial& far, const Polynomial& near) { return walk.formulas.never_negative(far - near); }

// Written for the reader in every case by this range and those that are the same bytes under other conditions.
bool range_defined(const Walk& walk, const Tracked& tracked, const ByteRange& range, const Fact& reader) {
  std::vector<const Fact*> facts;
  for (const ByteRange& other : tracked.bytes)
    if (other.begin.terms() == range.begin.terms() && other.end.terms() == range.end.terms()) facts.push_back(&other.fact);
  return covers(walk, facts, reader);
}

// Goes from range to range, each of which begins at or before the end of those before it. Formulas that overflow are as good as none.
bool bytes_defined(const Walk& walk, const Tracked& tracked, const ByteRange& wanted, const Fact& reader) {
  Polynomial reach = wanted.begin;
  std::vector<bool> taken(tracked.bytes.size());
  while (!reaches(walk, reach, wanted.end)) {
    size_t next = 0;
    for (; next < taken.size(); ++next) {
      const ByteRange& range = tracked.bytes[next];
      const bool fits = !taken[next] && reaches(walk, reach, range.begin) && reaches(walk, range.end, reach);
      if (fits && range_defined(walk, tracked, range, reader)) break;
    }
    if (next == taken.size()) return false;
    taken[next] = true;
    reach = tracked.bytes[next].end;
  }
  return true;
}

bool buffer_defined(const Walk& walk, const Tracked& tracked, const Resource& buffer, const Range& range, const Fact& reader) {
  if (cell_defined(walk, tracked, nullptr, reader)) return true;
  if (!range.offset.valid() && !buffer.count.valid()) return false;  // as long as the host makes it
  return bytes_defined(walk, tracked, bytes_of(walk, buffer, range, reader), reader);
}

// ---- the walk over passes ---------------------------------------------------------------------------------------

bool is_defined(const Walk& walk, const Access& access, const Fact& reader) {
  const Resource& resource = walk.graph.resources[access.resource];
  const Tracked& tracked = walk.tracked[access.resource.value];
  if (resource.kind == ResourceKind::image) return image_defined(walk, tracked, resource, access.range, reader);
  return buffer_defined(walk, tracked, resource, access.range, reader);
}

bool defined_from_start(const Resource& resource) {
  if (resource.lifetime == Lifetime::imported) return resource.before.role != Role::undefined;
  return resource.lifetime == Lifetime::persistent && resource.init == InitKind::clear;
}

// All of its range, for certain. What covers slices of a volume is an update of its mip.
bool defines(const Access& access) { return access.mode == Mode::write || access.clear || (is_slice(access) && access.covers); }

bool needs_earlier(const Access& access) { return !defines(access); }

// Whether `writer` writes something of what `reader` wants and no earlier pass writes always.
bool fills(const Walk& walk, const Access& reader, const Access& writer) {
  if (reader.resource != writer.resource || writer.age != 0 || writer.mode != Mode::write) return false;
  const Resource& resource = walk.graph.resources[reader.resource];
  const Tracked& tracked = walk.tracked[reader.resource.value];
  if (resource.kind == ResourceKind::buffer) {
    if (!reader.range.offset.valid() || !writer.range.offset.valid()) return true;
    const ByteRange wanted = bytes_of(walk, resource, reader.range, {}), has = bytes_of(walk, resource, writer.range, {});
    return !reaches(walk, wanted.begin, has.end) && !reaches(walk, has.begin, wanted.end);
  }
  const Row row = row_of(walk, resource);
  std::set<uint32_t> missing;
  each_cell(row, resource, reader.range, [&](uint32_t cell) {
    if (tracked.cells.empty() || !tracked.cells[cell].always) missing.insert(cell);
    return true;
  });
  return !each_cell(row, resource, writer.range, [&](uint32_t cell) { return !missing.contains(cell); });
}

const Pass* find_later_writer(const Walk& walk, uint32_t pass, const Access& reader) {
  for (uint32_t later = pass; later < walk.graph.passes.size(); ++later)
    for (const Access& access : walk.graph.passes.rows[later].accesses)
      if (fills(walk, reader, access)) return &walk.graph.passes.rows[later];
  return nullptr;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "`" : " and `") + word + "`";
  return text;
}

// Conditions of the host on which the writer runs and the reader need not.
std::string deciding(const Walk& walk, const Pass& reader, const Pass& writer) {
  std::vector<std::string> names;
  for (const ConditionId id : writer.conditions)
    if (!implies(reader.conditions, {id})) names.push_back(walk.checker.program.conditions[id].name);
  return joined(names);
}

// Values of features with which the reader is there and none of the writers is, the first such choice; empty: there is none.
std::string missing_with(const Walk& walk, const Pass& reader, const std::vector<uint32_t>& writers) {
  constexpr uint64_t kBudget = 16384;
  const auto& features = walk.checker.program.features;
  std::vector<bool> of_writers(features.size()), matters(features.size());
  const auto mention = [](const Guard& guard, std::vector<bool>& out) {
    for (const Guard::Term& term : guard.terms) out[term.feature.value] = true;
  };
  for (const uint32_t writer : writers) mention(walk.graph.passes.rows[writer].guard, of_writers);
  matters = of_writers;
  mention(reader.guard, matters);
  std::vector<std::string> words;
  const bool searched =
      each_configuration(features, FeatureValues(features.size(), kFreeFeature), matters, kBudget, [&](const FeatureValues& values) {
        const auto is_there = [&](uint32_t writer) { return holds(walk.graph.passes.rows[writer].guard, values); };
        if (!holds(reader.guard, values) || std::any_of(writers.begin(), writers.end(), is_there)) return true;
        for (uint32_t id = 0; id < features.size(); ++id)
          if (of_writers[id]) words.push_back(features.rows[id].name + "=" + features.rows[id].values[values[id]]);
        return false;
      });
  return words.empty() && !searched ? "some features" : joined(words);
}

std::string why_maybe(const Walk& walk, const Pass& reader, const Pass& pass, const std::vector<uint32_t>& writers) {
  if (const std::string names = deciding(walk, reader, pass); !names.empty()) return "the host decides by " + names + " whether it runs";
  if (const std::string values = missing_with(walk, reader, writers); !values.empty()) return "it is missing with " + values;
  if (pass.dispatch.kind == DispatchKind::indirect) return "its work is counted on the GPU; declare `clear` or `covers`";
  if (!pass.mip_limits.empty()) return "it is skipped where the extent leaves too few mips";
  return "it keeps what it does not touch; declare `clear` or `covers`";
}

bool untouched(const Tracked& tracked, const Cell& cell) {
  return !tracked.whole.always && tracked.whole.facts.empty() && !cell.always && cell.facts.empty();
}

// The first cell of the range that no pass ever writes for certain, if some do for others.
std::string first_missing(const Walk& walk, const Access& access) {
  const Resource& image = walk.graph.resources[access.resource];
  const Tracked& tracked = walk.tracked[access.resource.value];
  if (image.kind == ResourceKind::buffer) return tracked.bytes.empty() ? "" : "a part";
  uint32_t missing = UINT32_MAX;
  if (tracked.cells.empty()) return {};
  const Row row = row_of(walk, image);
  each_cell(row, image, access.range, [&](uint32_t cell) {
    if (untouched(tracked, tracked.cells[cell])) missing = cell;
    return missing == UINT32_MAX;
  });
  if (missing == UINT32_MAX) return {};
  return "mip " + std::to_string(mip_of_cell(row, image, missing)) + (row.of_slices ? ", slice " : ", layer ") + std::to_string(missing % row.width);
}

void explain(const Walk& walk, uint32_t pass, const Access& access, Diagnostic& diagnostic) {
  const Resource& resource = walk.graph.resources[access.resource];
  const Tracked& tracked = walk.tracked[access.resource.value];
  const std::string missing = first_missing(walk, access);
  if (missing.empty() && !tracked.may.empty()) {
    const Pass& writer = walk.graph.passes.rows[tracked.may.back()];
    const std::string why = why_maybe(walk, walk.graph.passes.rows[pass], writer, tracked.may);
    diagnostic.note(DiagnosticKind::WrittenMaybe, writer.span, {writer.name, why});
    return;
  }
  if (!missing.empty()) diagnostic.note(DiagnosticKind::WrittenPartly, access.span, {missing});
  if (const Pass* later = find_later_writer(walk, pass + 1, access)) diagnostic.note(DiagnosticKind::WrittenLater, later->span, {later->name});
  diagnostic.note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
}

const char* way_out(const Pass& pass, const Access& access) {
  if (access.mode == Mode::atomic) return "`clear`";
  const bool draws = access.role == Role::color || access.role == Role::depth || access.role == Role::stencil;
  return draws || pass.dispatch.kind == DispatchKind::indirect ? "`clear` or `covers`" : "`clear`, `covers` or `write`";
}

void report(Walk& walk, uint32_t pass, const Access& access) {
  if (walk.reported[access.resource.value]) return;
  walk.reported[access.resource.value] = true;
  const Resource& resource = walk.graph.resources[access.resource];
  const std::string& name = walk.graph.passes.rows[pass].name;
  Diagnostic diagnostic(DiagnosticKind::ReadBeforeWrite, access.span, {name, resource.name});
  if (access.mode != Mode::read)
    diagnostic = {DiagnosticKind::KeepsBeforeWrite, access.span, {name, resource.name, way_out(walk.graph.passes.rows[pass], access)}};
  explain(walk, pass, access, diagnostic);
  walk.checker.diagnostics.report(std::move(diagnostic));
}

void read(Walk& walk, uint32_t pass, const Access& access, const Fact& reader) {
  if (access.age > 0 || !needs_earlier(access)) return;
  if (!is_defined(walk, access, reader)) report(walk, pass, access);
}

void write(Walk& walk, uint32_t pass, const Access& access, const Fact& writer) {
  if (access.mode == Mode::read) return;
  const Resource& resource = walk.graph.resources[access.resource];
  Tracked& tracked = walk.tracked[access.resource.value];
  const bool certain = defines(access);
  walk.written[access.resource.value] = true;
  if (!certain || !writer.always()) tracked.may.push_back(pass);
  if (!certain) return;
  if (resource.kind == ResourceKind::image)
    define_image(walk, tracked, access.resource, resource, access.range, writer);
  else
    define_buffer(walk, tracked, resource, access.range, writer);
}

Range whole_range(const Resource& resource) {
  Range range;
  if (resource.kind == ResourceKind::image) range.aspects = info(resource.format).aspects;
  return range;
}

// The histories that some frame may leave as they were. What nothing writes at all is a mistake.
std::vector<ResourceId> find_carried(Walk& walk) {
  std::vector<ResourceId> carried;
  for (uint32_t id = 0; id < walk.graph.resources.size(); ++id) {
    const Resource& resource = walk.graph.resources.rows[id];
    if (resource.lifetime != Lifetime::history) continue;
    Access access;
    access.resource = ResourceId{size_t{id}};
    access.range = whole_range(resource);
    if (is_defined(walk, access, Fact{resource.guard, {}, {}})) continue;
    if (walk.written[id])
      carried.push_back(access.resource);
    else
      walk.checker.report(DiagnosticKind::HistoryNotWritten, resource.span, {resource.name});
  }
  return carried;
}

// An image of constant size always has the mips it declares.
std::vector<MipLimit> effective_limits(const Walk& walk, const Pass& pass) {
  std::vector<MipLimit> limits = pass.mip_limits;
  std::erase_if(limits, [&](const MipLimit& limit) {
    const Resource& image = walk.graph.resources[limit.image];
    return is_known(walk, image.width) && (!image.height.valid() || is_known(walk, image.height)) &&
           (!image.depth.valid() || is_known(walk, image.depth));
  });
  return limits;
}

Walk start(Checker& checker, const Graph& graph) {
  Walk walk{checker, graph, {}, {}, {}, Formulas(checker.program)};
  walk.tracked.resize(graph.resources.size());
  walk.reported.resize(graph.resources.size());
  walk.written.resize(graph.resources.size());
  for (uint32_t id = 0; id < graph.resources.size(); ++id)
    if (defined_from_start(graph.resources.rows[id])) walk.tracked[id].whole.always = true;
  return walk;
}

Fact when(const Walk& walk, const Pass& pass) { return {pass.guard, pass.conditions, effective_limits(walk, pass)}; }

}  // namespace

std::vector<ResourceId> find_carried(Checker& checker, const Graph& graph) {
  Walk walk = start(checker, graph);
  for (uint32_t pass = 0; pass < graph.passes.size(); ++pass)
    for (const Access& access : graph.passes.rows[pass].accesses) write(walk, pass, access, when(walk, graph.passes.rows[pass]));
  return find_carried(walk);
}

void check_definitions(Checker& checker, const Graph& graph, const std::set<uint32_t>& told) {
  Walk walk = start(checker, graph);
  for (const uint32_t resource : told) walk.reported[resource] = true;
  for (uint32_t pass = 0; pass < graph.passes.size(); ++pass) {
    const Pass& row = graph.passes.rows[pass];
    const Fact fact = when(walk, row);
    for (const Access& access : row.accesses) read(walk, pass, access, fact);
    for (const Access& access : row.accesses) write(walk, pass, access, fact);
  }
}

}  // namespace rg::dsl
