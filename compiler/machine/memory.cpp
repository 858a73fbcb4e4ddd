#include "compiler/machine/memory.h"

#include <algorithm>

namespace rg::machine {
namespace {

constexpr Layout kTornLayout = static_cast<Layout>(UINT32_MAX - 1);  // a transition raced with a write to the same memory

void replace(Memory& memory, uint32_t cell, Version version, bool shared) {
  memory.contents[cell] = version;
  memory.shared[cell] = shared;
  memory.seen_by[cell] = kNone;
  ++memory.stores[cell];
}

void store_in(Memory& memory, const Cells& cells, const Dirty& write) {
  const Version old = memory.contents[write.cell];
  Version version = write.version;
  if (write.shares) version.sum = (old.base == version.base ? old.sum : 0) + write.addend;
  replace(memory, write.cell, version, write.shares);
  for (const uint32_t rival : cells.rivals[write.cell]) replace(memory, rival, {version::poison, 0}, false);
}

struct Execution {
  Memory& memory;
  const Cells& cells;
  const Timeline& timeline;
  uint32_t index;
  bool hoards;
  const Event& event = timeline.events[index];

  Line& line(uint32_t agent, uint32_t cell) const { return memory.lines[size_t{agent} * cells.count + cell]; }

  bool in_layout(uint32_t cell) const { return !event.image || memory.layouts[cell] == layout_of_aspect(event.layout, cells.aspect_of[cell]); }
  bool same_memory(uint32_t a, uint32_t b) const {
    return a == b || std::find(cells.rivals[a].begin(), cells.rivals[a].end(), b) != cells.rivals[a].end();
  }

  void store(const Dirty& write) const { store_in(memory, cells, write); }

  // ---- ownership ----

  bool owns(uint32_t cell) const {
    if (event.family == kNone || event.takes) return true;
    return memory.released_by[cell] == kNone && (memory.owners[cell] == kNone || memory.owners[cell] == event.family);
  }
  void take(uint32_t cell) const {
    if (event.family == kNone) return;
    memory.owners[cell] = event.family;
    memory.released_by[cell] = kNone;
  }
  bool matches(const Event& release) const {
    return release.queue == event.other_queue && release.other_queue == event.queue && release.cells == event.cells &&
           release.old_layout == event.old_layout && release.new_layout == event.new_layout;
  }
  void lose(uint32_t cell) const { store({index, cell, {version::foreign, 0}}); }

  void change_owner(uint32_t cell) const {
    if (event.half == Half::none) {
      const bool transition = event.image && event.old_layout != event.new_layout;
      if (!transition || event.family == kNone) return;
      if (event.old_layout != Layout::undefined && !owns(cell)) lose(cell);
      return take(cell);
    }
    if (event.half == Half::release) {
      if (!owns(cell)) lose(cell);
      memory.released_by[cell] = index;
      return;
    }
    const uint32_t release = memory.released_by[cell];
    if (release == kNone || !matches(timeline.events[release])) lose(cell);
    take(cell);
  }

  // ---- accesses ----

  // Draws of one rendering find what earlier draws left, caches or not.
  const Dirty* written_in_rendering(uint32_t cell) const {
    for (size_t i = memory.dirty.size(); i-- > 0 && event.rendering != 0;)
      if (memory.dirty[i].cell == cell && in_this_pass(memory.dirty[i].event) && timeline.events[memory.dirty[i].event].pass != event.pass)
        return &memory.dirty[i];
    return nullptr;
  }

  Version find(uint32_t cell) const {
    if (event.lost) return {version::poison, 0};
    if (!owns(cell)) return {version::foreign, 0};
    if (!in_layout(cell)) return {version::wrong_layout, 0};
    if (const Dirty* own = written_in_rendering(cell)) return own->version;
    return hoards && !event.through_semaphore ? line(event.agent, cell).version : memory.contents[cell];
  }

  void read() const {
    if (event.takes)
      for (const uint32_t cell : event.cells) take(cell);
    if (event.through_semaphore) write_back(memory, cells, index);
    for (size_t k = 0; k < event.cells.size(); ++k) {
      const uint32_t cell = event.cells[k];
      const Version expected = event.expected[k], found = find(cell);
      if (expected.base == version::undefined) continue;
      const bool right = found.base == expected.base && (event.shares || found.sum == expected.sum);
      if (!right) memory.mismatches.push_back({index, cell, expected, found});
      if (right && memory.seen_by[cell] == kNone) memory.seen_by[cell] = index;
    }
  }

  bool in_this_pass(uint32_t other) const {
    const Event& e = timeline.events[other];
    return e.frame == event.frame && (e.pass == event.pass || (event.rendering != 0 && e.rendering == event.rendering));
  }

  // Two writes may land in any order unless the first was made available, and made visible to the second or seen by another pass.
  bool races(uint32_t cell) const {
    for (const Dirty& other : memory.dirty)
      if (!in_this_pass(other.event) && same_memory(other.cell, cell) && !(other.shares && event.shares)) return true;
    if (memory.shared[cell] && event.shares) return false;
    const bool seen = memory.seen_by[cell] != kNone && !in_this_pass(memory.seen_by[cell]);
    return !seen && line(event.agent, cell).store != memory.stores[cell];
  }

  Dirty result_for(size_t k) const {
    const uint32_t cell = event.cells[k];
    Dirty write{index, cell, event.result[k], 0, event.shares};
    write.addend = event.result[k].sum - (event.result[k].base == event.expected[k].base ? event.expected[k].sum : 0);
    const auto spoil = [&](uint64_t base) { write.version = {base, 0}, write.shares = false; };
    if (event.lost) spoil(version::poison);
    if (!in_layout(cell)) spoil(version::wrong_layout);
    if (!owns(cell)) spoil(version::foreign);
    if (hoards && races(cell)) spoil(version::torn);
    return write;
  }

  void write() const {
    for (size_t k = 0; k < event.cells.size(); ++k) {
      const Dirty write = result_for(k);
      if (owns(event.cells[k])) take(event.cells[k]);
      if (!hoards) {
        store(write);
        continue;
      }
      std::erase_if(memory.dirty, [&](const Dirty& other) {
        return other.cell == write.cell && timeline.events[other.event].partial && in_this_pass(other.event);
      });
      memory.dirty.push_back(write);
    }
  }

  void bring() const {
    for (size_t k = 0; k < event.cells.size(); ++k) {
      const uint32_t cell = event.cells[k];
      take(cell);
      memory.layouts[cell] = layout_of_aspect(event.layout, cells.aspect_of[cell]);
      const Dirty write{index, cell, event.result[k], 0, false};
      if (event.pending && hoards) {
        memory.dirty.push_back(write);
        continue;
      }
      store(write);
      memory.seen_by[cell] = index;
      drop_lines(event.dst_agents, cell);
    }
  }

  // ---- synchronisation ----

  bool covers(uint32_t cell) const {
    if (event.resource == kNone) return true;
    return std::any_of(event.cells.begin(), event.cells.end(), [&](uint32_t own) { return own == cell || (event.image && same_memory(own, cell)); });
  }

  void make_available() const {
    std::vector<Dirty> kept;
    for (const Dirty& write : memory.dirty) {
      const Event& writer = timeline.events[write.event];
      const bool earlier = write.event < index && writer.queue == event.queue;
      if (earlier && event.src_agents[writer.agent] && covers(write.cell))
        store(write);
      else
        kept.push_back(write);
    }
    memory.dirty = std::move(kept);
  }

  void change_layout(uint32_t cell) const {
    const uint32_t aspect = cells.aspect_of[cell];
    const Layout from = layout_of_aspect(event.old_layout, aspect), to = layout_of_aspect(event.new_layout, aspect);
    Layout& layout = memory.layouts[cell];
    if (from == to && from == layout) return;
    if (from == Layout::undefined)
      store({index, cell, {version::poison, 0}});
    else if (from != layout)
      store({index, cell, {version::wrong_layout, 0}});
    else
      replace(memory, cell, memory.contents[cell], false);
    for (uint32_t agent = 0; agent < timeline.agents.size(); ++agent) line(agent, cell).version = {version::wrong_layout, 0};
    const bool raced = std::any_of(memory.dirty.begin(), memory.dirty.end(), [&](const Dirty& write) { return same_memory(write.cell, cell); });
    layout = raced ? kTornLayout : to;
  }

  void drop_lines(const AgentSet& agents, uint32_t cell) const {
    for (uint32_t agent = 0; agent < timeline.agents.size(); ++agent)
      if (agents[agent]) line(agent, cell) = {memory.contents[cell], memory.stores[cell]};
  }

  void synchronise() const {
    if (hoards) make_available();
    for (const uint32_t cell : event.cells) change_owner(cell);
    // A transfer changes the layout once, between its halves.
    if (event.image && event.half != Half::release)
      for (const uint32_t cell : event.cells) change_layout(cell);
    if (!hoards || event.dst_agents.none()) return;
    if (event.resource == kNone)
      for (uint32_t cell = 0; cell < cells.count; ++cell) drop_lines(event.dst_agents, cell);
    for (const uint32_t cell : event.cells) drop_lines(event.dst_agents, cell);
  }
};

}  // namespace

Memory initial_memory(const Subject& subject, const Timeline& timeline) {
  Memory memory;
  memory.contents.assign(subject.cells.count, {version::poison, 0});
  memory.layouts.assign(subject.cells.count, Layout::undefined);
  memory.stores.assign(subject.cells.count, 0);
  memory.seen_by.assign(subject.cells.count, kNone);
  memory.shared.assign(subject.cells.count, false);
  memory.owners.assign(subject.cells.count, kNone);
  memory.released_by.assign(subject.cells.count, kNone);
  for (uint32_t r = 0; r < subject.cells.resources.size(); ++r) {
    const ResourceCells& resource = subject.cells.resources[r];
    for (uint32_t copy = 0; copy < resource.copies; ++copy)
      for (uint32_t piece = 0; piece < resource.pieces.size(); ++piece)
        if (subject.reference.initial[r][piece].base != version::undefined)
          memory.contents[physical_cell(resource, piece, 0, copy)] = subject.reference.initial[r][piece];
  }
  for (const auto& [cell, layout] : timeline.initial_layouts) memory.layouts[cell] = layout_of_aspect(layout, subject.cells.aspect_of[cell]);
  for (const auto& [cell, family] : timeline.initial_owners) memory.owners[cell] = family;
  for (size_t agent = 0; agent < timeline.agents.size(); ++agent)
    for (const Version& version : memory.contents) memory.lines.push_back({version, 0});
  return memory;
}

void execute(Memory& memory, const Cells& cells, const Timeline& timeline, uint32_t event, Caches caches) {
  const Execution execution{memory, cells, timeline, event, caches == Caches::hoard};
  switch (execution.event.kind) {
    case EventKind::read:
      return execution.read();
    case EventKind::write:
      return execution.write();
    case EventKind::barrier:
      return execution.synchronise();
    case EventKind::bring:
      return execution.bring();
  }
}

void write_back(Memory& memory, const Cells& cells, uint32_t end) {
  std::erase_if(memory.dirty, [&](const Dirty& write) {
    if (write.event < end) store_in(memory, cells, write);
    return write.event < end;
  });
}

}  // namespace rg::machine
