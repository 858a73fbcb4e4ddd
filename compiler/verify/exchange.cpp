#include "compiler/verify/exchange.h"

#include <algorithm>
#include <initializer_list>

#include "compiler/verify/cells.h"
#include "compiler/verify/roles.h"

namespace rg::verify {
namespace {

bool outlives_frame(const dsl::Resource& resource) {
  if (resource.is_output) return true;
  if (resource.lifetime == dsl::Lifetime::imported) return resource.after.role != dsl::Role::undefined;
  return resource.lifetime != dsl::Lifetime::transient;
}

// Of bytes.
struct Interval {
  uint64_t begin = 0, end = UINT64_MAX;
};
// One subresource of an image, or bytes of a buffer at whose inside no access begins or ends, as far as that is known.
struct Spot {
  uint32_t resource = 0, age = 0;
  uint32_t aspect = 0, mip = 0, layer = 0;
  Interval bytes = {};
};

bool holds(uint32_t begin, uint32_t count, uint32_t at) { return at >= begin && (count == dsl::kAll || at - begin < count); }

class Exchange {
 public:
  Exchange(const dsl::Program& program, const dsl::Graph& graph, uint32_t first, uint32_t second, const std::vector<uint32_t>& rest)
      : program_(program), graph_(graph), first_(first), second_(second), rest_(rest) {}

  bool is_noticed() const {
    for (const dsl::Access& x : pass(first_).accesses)
      for (const dsl::Access& y : pass(second_).accesses)
        if (conflict(x, y) && is_noticed(x, y)) return true;
    return false;
  }

 private:
  const dsl::Pass& pass(uint32_t index) const { return graph_.passes.rows[index]; }

  static bool conflict(const dsl::Access& x, const dsl::Access& y) {
    return x.resource == y.resource && x.age == y.age && (writes_contents(x) || writes_contents(y)) && !(commutes(x) && commutes(y));
  }
  bool is_noticed(const dsl::Access& x, const dsl::Access& y) const {
    const bool finds = uses_contents(pass(first_), x) || uses_contents(pass(second_), y);
    const std::vector<Spot> spots = spots_of(x);
    return std::any_of(spots.begin(), spots.end(),
                       [&](const Spot& spot) { return touches(x, spot) && touches(y, spot) && (finds || is_found(spot)); });
  }

  // Both wrote there. Whoever comes next may do so too, and only then: what they left is gone before anybody has seen it.
  bool is_found(const Spot& spot) const {
    std::vector<uint32_t> replacing;  // passes that run in some frames only
    for (const uint32_t next : rest_) {
      const bool replaced = std::any_of(replacing.begin(), replacing.end(), [&](uint32_t p) { return runs(p, spot, {first_, second_, next}); });
      for (const dsl::Access& access : pass(next).accesses)
        if (!replaced && touches(access, spot) && uses_contents(pass(next), access)) return true;
      if (!replaces(next, spot)) continue;
      if (runs(next, spot, {first_, second_})) return false;
      replacing.push_back(next);
    }
    return outlives_frame(graph_.resources.rows[spot.resource]);
  }
  bool replaces(uint32_t index, const Spot& spot) const {
    const auto& accesses = pass(index).accesses;
    return std::any_of(accesses.begin(), accesses.end(), [&](const dsl::Access& access) {
      return covers(access, spot) && writes_contents(access) && !uses_contents(pass(index), access) && !commutes(access);
    });
  }

  // The pass runs in all frames in which `others` do, and the spot exists.
  bool runs(uint32_t index, const Spot& spot, std::initializer_list<uint32_t> others) const {
    const auto& conditions = pass(index).conditions;
    const auto& limits = pass(index).mip_limits;
    const auto holds_for_one = [&](const dsl::ConditionId condition) {
      return std::any_of(others.begin(), others.end(), [&](uint32_t other) {
        return std::find(pass(other).conditions.begin(), pass(other).conditions.end(), condition) != pass(other).conditions.end();
      });
    };
    const auto exists = [&](const dsl::MipLimit& limit) {
      const auto more = [&](const dsl::MipLimit& known) { return known.image == limit.image && known.mip >= limit.mip; };
      return more({dsl::ResourceId{size_t{spot.resource}}, spot.mip}) || std::any_of(others.begin(), others.end(), [&](uint32_t other) {
               return std::any_of(pass(other).mip_limits.begin(), pass(other).mip_limits.end(), more);
             });
    };
    return std::all_of(conditions.begin(), conditions.end(), holds_for_one) && std::all_of(limits.begin(), limits.end(), exists);
  }

  // ---- places -----------------------------------------------------------------------------------------------------------

  bool is_number(dsl::ExprId id) const { return program_.exprs[id].op == dsl::ExprOp::constant; }
  bool is_exact(const dsl::Access& access) const {
    const dsl::Range& range = access.range;
    return (!range.offset.valid() || is_number(range.offset)) && (!range.size.valid() || is_number(range.size));
  }
  // The least known to hold all of them. The length of the buffer may depend on extents: who takes all of the rest has no end then.
  Interval bytes_of(const dsl::Access& access) const {
    const auto value = [&](dsl::ExprId id) { return static_cast<uint64_t>(program_.exprs[id].value); };
    const dsl::Resource& buffer = graph_.resources[access.resource];
    Interval bytes;
    if (buffer.count.valid() && is_number(buffer.count)) bytes.end = value(buffer.count) * std::max(buffer.stride, 1u);
    if (!is_exact(access)) return bytes;
    if (access.range.offset.valid()) bytes.begin = value(access.range.offset);
    if (access.range.size.valid()) bytes.end = std::min(bytes.end, bytes.begin + value(access.range.size));
    return bytes;
  }

  bool is_image(uint32_t resource) const { return graph_.resources.rows[resource].kind == dsl::ResourceKind::image; }
  bool in_image(const dsl::Access& access, const Spot& spot) const {
    const dsl::Range range = effective_range(access, aspects_of(graph_.resources.rows[spot.resource].format));
    return (range.aspects & spot.aspect) != 0 && holds(range.mip, range.mips, spot.mip) && holds(range.layer, range.layers, spot.layer);
  }
  // Some of the spot, perhaps.
  bool touches(const dsl::Access& access, const Spot& spot) const {
    if (access.resource.value != spot.resource || access.age != spot.age) return false;
    if (is_image(spot.resource)) return in_image(access, spot);
    const Interval bytes = bytes_of(access);
    return bytes.begin < spot.bytes.end && spot.bytes.begin < bytes.end;
  }
  // All of the spot, certainly.
  bool covers(const dsl::Access& access, const Spot& spot) const {
    if (access.resource.value != spot.resource || access.age != spot.age) return false;
    if (is_image(spot.resource)) return in_image(access, spot);
    const Interval bytes = bytes_of(access);
    return is_exact(access) && bytes.begin <= spot.bytes.begin && spot.bytes.end <= bytes.end;
  }

  std::vector<Spot> spots_of(const dsl::Access& access) const {
    const Spot all{access.resource.value, access.age};
    return is_image(all.resource) ? subresources(all) : pieces(all);
  }
  std::vector<Spot> subresources(Spot spot) const {
    const dsl::Resource& image = graph_.resources.rows[spot.resource];
    std::vector<Spot> spots;
    for (spot.aspect = aspect_color; spot.aspect <= aspect_stencil; spot.aspect *= 2)
      for (spot.mip = 0; spot.mip < std::max(image.mips, 1u); ++spot.mip)
        for (spot.layer = 0; spot.layer < std::max(image.layers, 1u); ++spot.layer) spots.push_back(spot);
    return spots;
  }
  std::vector<Spot> pieces(Spot spot) const {
    std::vector<uint64_t> cuts{0};
    for (const dsl::Pass& pass : graph_.passes)
      for (const dsl::Access& access : pass.accesses)
        if (access.resource.value == spot.resource) {
          const Interval bytes = bytes_of(access);
          cuts.insert(cuts.end(), {bytes.begin, bytes.end});
        }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Spot> spots;
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
      spot.bytes = {cuts[i], cuts[i + 1]};
      if (cuts[i] != cuts[i + 1]) spots.push_back(spot);
    }
    return spots;
  }

  const dsl::Program& program_;
  const dsl::Graph& graph_;
  const uint32_t first_, second_;
  const std::vector<uint32_t>& rest_;
};

}  // namespace

bool may_exchange(const dsl::Program& program, const dsl::Graph& graph, uint32_t first, uint32_t second, const std::vector<uint32_t>& rest) {
  return !Exchange(program, graph, first, second, rest).is_noticed();
}

}  // namespace rg::verify
