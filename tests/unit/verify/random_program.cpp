#include "tests/unit/verify/random_program.h"

#include <algorithm>
#include <random>
#include <string>

namespace rg::verify {
namespace {

using namespace dsl;

// A subresource, or a whole buffer, as definitions are followed.
struct Spot {
  uint32_t resource = 0, mip = 0, layer = 0;
};

class Generator {
 public:
  Generator(uint64_t seed, const RandomShape& shape) : random_(seed), queues_(seed ^ 0x51ED270Bu), shape_(shape) {}

  Program make() {
    declare();
    for (uint32_t i = 0; i < shape_.passes; ++i) add_pass();
    finish();
    program_.graphs.add(std::move(graph_));
    return std::move(program_);
  }

 private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  bool one_in(uint32_t n) { return below(n) == 0; }

  // ---- declarations -----------------------------------------------------------------------------------------------

  ExprId constant(int64_t value) { return program_.exprs.add({ExprOp::constant, {}, {}, value}); }
  ExprId axis(uint32_t a, int64_t divisor) {
    const ExprId extent = program_.exprs.add({ExprOp::extent, {}, {}, a});
    return divisor == 1 ? extent : program_.exprs.add({ExprOp::ceil_div, extent, constant(divisor), 0});
  }

  void declare() {
    program_.module = "random";
    graph_.name = "frame";
    program_.extents.add({"view", {640, 360, 1}, {1920, 1080, 1}, 2, {}});
    for (uint32_t i = 0; i < shape_.conditions; ++i) program_.conditions.add({"c" + std::to_string(i), {}});
    Resource surface = image_row("surface", Format::rgba8, 1);
    surface.lifetime = Lifetime::imported;
    surface.after.role = Role::present;
    surface.is_surface = surface.is_output = true;
    add_resource(surface);
    for (uint32_t i = 0; i < shape_.images; ++i) declare_image(i);
    for (uint32_t i = 0; i < shape_.buffers; ++i) declare_buffer(i);
    shared_ = static_cast<uint32_t>(graph_.resources.size());
    for (uint32_t i = 0; i < 2 && shape_.folds; ++i) declare_samples(i);
  }

  Resource image_row(const std::string& name, Format format, int64_t divisor) {
    Resource row;
    row.name = name, row.module = "random";
    row.format = format;
    row.width = axis(0, divisor), row.height = axis(1, divisor);
    return row;
  }

  void declare_image(uint32_t i) {
    constexpr Format kFormats[] = {Format::rgba16f, Format::rgba16f, Format::r32ui, Format::d32f, Format::d32f_s8};
    const uint32_t divisor = 1 + below(3);
    const Format format = kFormats[below(5)];
    Resource row = image_row("i" + std::to_string(i), format, divisor);
    if (row.format == Format::rgba16f || row.format == Format::r32ui) row.mips = 1 + below(4);
    row.layers = one_in(3) ? 2 + below(3) : 1;
    keep_some(row, i);
    add_resource(row);
  }

  // An image of several samples, and the one it is resolved to; nothing else uses the first.
  void declare_samples(uint32_t i) {
    Resource one = image_row("s" + std::to_string(i), Format::rgba16f, 1), many = one;
    many.name = "m" + std::to_string(i), many.samples = 4;
    add_resource(one);
    add_resource(many);
  }

  void declare_buffer(uint32_t i) {
    Resource row;
    row.name = "b" + std::to_string(i), row.module = "random";
    row.kind = ResourceKind::buffer;
    row.element.scalar = Scalar::u32;
    row.stride = 4;
    row.count = one_in(2) ? constant(64 << below(6)) : axis(0, 1 + below(8));
    keep_some(row, i);
    if (row.lifetime == Lifetime::transient && one_in(4)) row.lifetime = Lifetime::readback, row.is_output = true;
    add_resource(row);
  }

  // Most are transient.
  void keep_some(Resource& row, uint32_t i) {
    if (i == 0) {
      row.lifetime = Lifetime::history, row.history = 1 + below(2), row.init = InitKind::clear;
      row.mips = row.layers = 1;
    } else if (one_in(8)) {
      row.lifetime = Lifetime::persistent, row.init = InitKind::clear;
    } else if (one_in(8)) {
      row.lifetime = Lifetime::imported;
      const bool color = row.kind == ResourceKind::buffer || row.format == Format::rgba16f || row.format == Format::r32ui;
      row.before = {color && one_in(2)                ? Role::storage
                    : row.kind == ResourceKind::image ? Role::sampled
                                                      : Role::storage,
                    one_in(2) ? stage_compute : stage_fragment, false};
      row.before.wrote = row.before.role == Role::storage && one_in(2);
      row.after = row.before;
      row.after.wrote = false;
    }
    row.no_alias = row.lifetime == Lifetime::transient && one_in(12);
  }

  void add_resource(const Resource& row) {
    const bool defined = row.lifetime == Lifetime::persistent || (row.lifetime == Lifetime::imported && row.before.role != Role::undefined);
    defined_.emplace_back(row.kind == ResourceKind::buffer ? 2 : row.mips * row.layers, defined);
    graph_.resources.add(row);
  }

  // ---- definitions ------------------------------------------------------------------------------------------------

  const Resource& row(uint32_t r) const { return graph_.resources.rows[r]; }
  bool is_image(uint32_t r) const { return row(r).kind == ResourceKind::image; }
  bool is_depth(uint32_t r) const { return is_image(r) && (row(r).format == Format::d32f || row(r).format == Format::d32f_s8); }
  uint32_t any_resource() { return below(shared_); }

  // All of a buffer, or one half where its size is known.
  Range any_bytes(uint32_t r) {
    Range range;
    const Expr& count = program_.exprs[row(r).count];
    if (count.op != ExprOp::constant || !one_in(3)) return range;
    const int64_t half = count.value * row(r).stride / 2;
    range.offset = constant(one_in(2) ? 0 : half), range.size = constant(half);
    return range;
  }
  // One subresource, one mip with all layers, or everything.
  Range any_range(uint32_t r) {
    Range range;
    if (!is_image(r)) return any_bytes(r);
    if (one_in(3)) return range;
    range.mip = below(row(r).mips), range.mips = 1;
    if (row(r).layers > 1 && one_in(2)) range.layer = below(row(r).layers), range.layers = 1;
    return range;
  }
  template <class Visit>
  void each_spot(uint32_t r, const Range& range, Visit visit) {
    if (!is_image(r)) {
      const bool whole = !range.offset.valid(), upper = !whole && program_.exprs[range.offset].value != 0;
      if (whole || !upper) visit(0);
      if (whole || upper) visit(1);
      return;
    }
    for (uint32_t m = range.mip; m < (range.mips == kAll ? row(r).mips : range.mip + range.mips); ++m)
      for (uint32_t l = range.layer; l < (range.layers == kAll ? row(r).layers : range.layer + range.layers); ++l) visit(m * row(r).layers + l);
  }
  bool is_defined(uint32_t r, const Range& range) {
    bool all = true;
    each_spot(r, range, [&](uint32_t spot) { all = all && defined_[r][spot]; });
    return all;
  }
  void define(uint32_t r, const Range& range) {
    each_spot(r, range, [&](uint32_t spot) { defined_[r][spot] = true; });
  }

  // ---- passes -----------------------------------------------------------------------------------------------------

  Access access(uint32_t r, const Range& range, Mode mode, Role role, uint32_t stages) {
    Access a;
    a.resource = ResourceId{size_t{r}};
    a.range = range, a.mode = mode, a.role = role, a.stages = stages;
    a.name = "a" + std::to_string(pass_.accesses.size());
    return a;
  }
  bool touched(uint32_t r) const {
    return std::any_of(pass_.accesses.begin(), pass_.accesses.end(), [&](const Access& a) { return a.resource.value == r && a.age == 0; });
  }
  // A limit would make earlier writes of the pass uncertain.
  bool may_limit(uint32_t r, const Range& range) const {
    if (!is_image(r) || range.mips != 1 || range.mip == 0) return true;
    return std::none_of(pass_.accesses.begin(), pass_.accesses.end(), [](const Access& a) { return a.mode != Mode::read; });
  }
  void limit_mips(uint32_t r, const Range& range) {
    if (is_image(r) && range.mips == 1 && range.mip > 0) pass_.mip_limits.push_back({ResourceId{size_t{r}}, range.mip});
  }
  // The pass runs wherever the range exists.
  bool runs_for(uint32_t r, const Range& range) const {
    return pass_.conditions.empty() && std::all_of(pass_.mip_limits.begin(), pass_.mip_limits.end(),
                                                   [&](const MipLimit& limit) { return limit.image.value == r && range.mip >= limit.mip; });
  }

  void add_reads(uint32_t stage) {
    for (uint32_t n = below(4); n > 0; --n) {
      const uint32_t r = any_resource();
      const Range range = any_range(r);
      if (row(r).lifetime == Lifetime::history && one_in(2)) {
        Access a = access(r, {}, Mode::read, is_image(r) ? Role::sampled : Role::storage, stage);
        a.age = 1 + below(row(r).history);
        if (std::none_of(pass_.accesses.begin(), pass_.accesses.end(), [&](const Access& o) { return o.resource == a.resource && o.age == a.age; }))
          pass_.accesses.push_back(a);
        continue;
      }
      if (touched(r) || !is_defined(r, range) || !may_limit(r, range) || r == 0) continue;
      pass_.accesses.push_back(access(r, range, Mode::read, read_role(r), stage));
      limit_mips(r, range);
    }
  }
  Role read_role(uint32_t r) {
    if (is_depth(r)) return Role::sampled;
    if (is_image(r)) return one_in(3) ? Role::storage : Role::sampled;
    if (row(r).lifetime == Lifetime::readback) return Role::storage;
    return one_in(3) ? Role::uniform : Role::storage;
  }

  // A storage write: everything where that is sure, otherwise an update of what is defined.
  bool add_storage_write(uint32_t stage) {
    const uint32_t r = any_resource();
    const Range range = any_range(r);
    if (touched(r) || is_depth(r) || r == 0) return false;
    return add_write(access(r, range, Mode::write, Role::storage, stage), r, range);
  }
  bool add_write(Access a, uint32_t r, const Range& range) {
    const bool defined = is_defined(r, range), sure = runs_for(r, range);
    if ((!defined && !sure) || !may_limit(r, range)) return false;
    limit_mips(r, range);
    if (defined && one_in(2) && a.role == Role::storage) a.mode = Mode::update;
    if (a.mode == Mode::update && one_in(4)) a.mode = Mode::atomic;
    if (a.mode == Mode::update && one_in(6)) a.disjoint = true;
    pass_.accesses.push_back(a);
    if (sure) define(r, range);
    return true;
  }

  void add_pass() {
    if (shape_.folds && one_in(5)) return add_samples();
    pass_ = {};
    pass_.name = "p" + std::to_string(graph_.passes.size()), pass_.module = "random";
    if (one_in(5) && shape_.conditions > 0) pass_.conditions.push_back(ConditionId{size_t{below(shape_.conditions)}});
    const uint32_t kind = below(6);
    const bool made = kind < 3 ? add_compute() : kind < 5 ? add_raster() : add_transfer();
    if (!made) return;
    if (shape_.folds) wipe_some();
    choose_queue();
    if (one_in(10) && graph_.passes.size() > 0) pass_.after.push_back(PassId{size_t{below(static_cast<uint32_t>(graph_.passes.size()))}});
    graph_.passes.add(pass_);
  }

  // A pass in front of this one that clears what it loads, or something else of the same image.
  void wipe_some() {
    for (const Access& drawn : pass_.accesses) {
      if (drawn.mode != Mode::update || (drawn.role != Role::color && drawn.role != Role::depth) || one_in(3)) continue;
      Pass wipe;
      wipe.name = "wipe" + std::to_string(graph_.passes.size()), wipe.module = "random";
      wipe.kind = PassKind::transfer;
      if (!one_in(6)) wipe.conditions = pass_.conditions;
      wipe.mip_limits = pass_.mip_limits;
      Access cleared = drawn;
      cleared.role = Role::clear_dst, cleared.mode = Mode::write, cleared.blend = {};
      cleared.range.aspects = is_depth(drawn.resource.value) ? 2 : 1;
      if (one_in(6)) cleared.range.layer = 0, cleared.range.layers = kAll;
      wipe.accesses.push_back(cleared);
      wipe.transfers.push_back({TransferKind::clear, kAll, 0, Filter::nearest, {}, {}});
      graph_.passes.add(wipe);
    }
  }

  // Draws into an image of several samples, perhaps again, resolves it, and somebody looks.
  void add_samples() {
    const uint32_t one = shared_ + 2 * below(2), many = one + 1;
    const auto named = [&](PassKind kind) {
      pass_ = {};
      pass_.name = "p" + std::to_string(graph_.passes.size()), pass_.module = "random";
      pass_.kind = kind;
    };
    for (uint32_t n = 1 + below(2); n > 0; --n) {
      named(PassKind::raster);
      const bool keeps = is_defined(many, {}) && one_in(2);
      Access drawn = access(many, {}, keeps ? Mode::update : Mode::write, Role::color, 0);
      if (!keeps) drawn.clear = ClearValue{};
      pass_.accesses.push_back(drawn);
      define(many, {});
      wipe_some();
      graph_.passes.add(pass_);
      if (one_in(3) && is_defined(one, {})) look_at(one, named);
    }
    named(PassKind::transfer);
    pass_.accesses.push_back(access(many, {}, Mode::read, Role::resolve_src, 0));
    pass_.accesses.push_back(access(one, {}, Mode::write, Role::resolve_dst, 0));
    pass_.transfers.push_back({TransferKind::resolve, 0, 1, Filter::nearest, {}, {}});
    graph_.passes.add(pass_);
    define(one, {});
    look_at(one, named);
  }
  template <class Named>
  void look_at(uint32_t image, Named named) {
    named(PassKind::raster);
    pass_.accesses.push_back(access(image, {}, Mode::read, Role::sampled, stage_fragment));
    pass_.accesses.push_back(access(0, {}, Mode::write, Role::color, 0));
    pass_.accesses.back().mode = is_defined(0, {}) ? Mode::update : Mode::write;
    if (!is_defined(0, {})) pass_.accesses.back().clear = ClearValue{};
    define(0, {});
    graph_.passes.add(pass_);
  }

  // Orders and permissions; what a transfer queue cannot do stays away from it.
  void choose_queue() {
    const auto chance = [&](uint32_t n) { return queues_() % n == 0; };
    if (pass_.kind == PassKind::raster || chance(2)) return;
    const bool clears_image = std::any_of(pass_.accesses.begin(), pass_.accesses.end(), [](const Access& a) { return a.role == Role::clear_dst; });
    pass_.queue = pass_.kind == PassKind::transfer && !clears_image && chance(2) ? QueueKind::transfer : QueueKind::compute;
    // What the engine brings, and what commutes, stays with its like, so that orders to leave the graphics queue cannot always be followed.
    const bool imports = std::any_of(pass_.accesses.begin(), pass_.accesses.end(), [&](const Access& a) {
      return row(a.resource.value).lifetime == Lifetime::imported || a.mode == Mode::atomic || a.disjoint;
    });
    pass_.queue_may = imports || !chance(3);
  }

  bool add_compute() {
    pass_.kind = PassKind::compute;
    add_reads(stage_compute);
    bool writes = false;
    for (uint32_t n = 1 + below(2); n > 0; --n) writes = add_storage_write(stage_compute) || writes;
    return writes;
  }

  bool add_raster() {
    pass_.kind = PassKind::raster;
    if (shape_.continues && one_in(2)) return continue_rendering();
    add_reads(one_in(4) ? stage_vertex | stage_fragment : stage_fragment);
    bool writes = false;
    for (uint32_t n = 1 + below(2); n > 0; --n) writes = add_color(one_in(6) ? 0 : any_resource()) || writes;
    writes = add_depth(any_resource()) || writes;
    if (one_in(4)) writes = add_storage_write(stage_fragment) || writes;
    return writes;
  }
  // The attachments of the last raster pass, kept.
  bool continue_rendering() {
    const auto& passes = graph_.passes.rows;
    const auto last = std::find_if(passes.rbegin(), passes.rend(), [](const Pass& pass) { return pass.kind == PassKind::raster; });
    if (last == passes.rend()) return false;
    bool writes = false;
    for (Access a : last->accesses) {
      if (a.role != Role::color && a.role != Role::depth && a.role != Role::depth_readonly) continue;
      const uint32_t r = a.resource.value;
      if (!is_defined(r, a.range) || !may_limit(r, a.range)) return false;
      limit_mips(r, a.range);
      a.clear = {}, a.covers = false;
      if (a.role == Role::color) a.mode = Mode::update, a.blend.enabled = one_in(2) && row(r).format != Format::r32ui;
      if (a.role != Role::color) a.role = one_in(2) ? Role::depth : Role::depth_readonly;
      if (a.role == Role::depth) a.mode = Mode::update;
      if (a.role == Role::depth_readonly) a.mode = Mode::read;
      writes = writes || a.mode != Mode::read;
      pass_.accesses.push_back(a);
    }
    if (one_in(2)) add_reads(stage_fragment);
    if (one_in(4)) writes = add_storage_write(stage_fragment) || writes;
    return writes;
  }
  Range attachment_range(uint32_t r) {
    Range range;
    range.mip = below(row(r).mips), range.mips = 1;
    if (row(r).layers > 1 && one_in(2)) range.layer = below(row(r).layers), range.layers = 1;
    return range;
  }
  bool add_color(uint32_t r) {
    if (!is_image(r) || is_depth(r) || touched(r)) return false;
    return add_attachment(access(r, attachment_range(r), Mode::update, Role::color, 0), r);
  }
  bool add_depth(uint32_t r) {
    if (!is_depth(r) || touched(r)) return false;
    Access a = access(r, attachment_range(r), Mode::update, Role::depth, 0);
    if (is_defined(r, a.range) && one_in(3)) {
      a.role = Role::depth_readonly, a.mode = Mode::read;
      pass_.accesses.push_back(a);
      Access sampled = access(r, a.range, Mode::read, Role::sampled, stage_fragment);
      if (one_in(2)) pass_.accesses.push_back(sampled);
      return false;
    }
    return add_attachment(a, r);
  }
  bool add_attachment(Access a, uint32_t r) {
    const bool defined = is_defined(r, a.range), sure = runs_for(r, a.range);
    const bool keeps = defined && one_in(2);
    if ((!keeps && !sure && !defined) || !may_limit(r, a.range)) return false;
    limit_mips(r, a.range);
    if (!keeps) {
      a.mode = Mode::write;
      if (a.role == Role::color && one_in(3))
        a.covers = true;
      else
        a.clear = ClearValue{};
    }
    a.blend.enabled = a.role == Role::color && keeps && one_in(2) && row(r).format != Format::r32ui;
    pass_.accesses.push_back(a);
    if (sure) define(r, a.range);
    return true;
  }

  bool add_transfer() {
    pass_.kind = PassKind::transfer;
    return one_in(2) ? add_copy() : add_clear();
  }
  bool add_copy() {
    const uint32_t from = any_resource(), to = any_resource();
    if (from == to || to == 0 || from == 0 || is_image(from) != is_image(to)) return false;
    if (is_image(from) && row(from).format == Format::d32f_s8) return false;  // the stencil may be undefined
    if (is_image(from) && (row(from).format != row(to).format || row(from).layers != 1 || row(to).layers != 1)) return false;
    Range range;
    if (is_image(from)) range.mips = 1;
    if (!is_defined(from, range)) return false;
    pass_.accesses.push_back(access(from, range, Mode::read, Role::copy_src, 0));
    pass_.transfers.push_back({TransferKind::copy, 0, 1, Filter::nearest, {}, {}});
    return add_write(access(to, range, Mode::write, Role::copy_dst, 0), to, range);
  }
  bool add_clear() {
    const uint32_t r = any_resource();
    if (is_depth(r) || r == 0) return false;
    const Range range = is_image(r) ? any_range(r) : Range{};
    const TransferKind kind = is_image(r) ? TransferKind::clear : TransferKind::fill;
    pass_.transfers.push_back({kind, kAll, 0, Filter::nearest, {}, {}});
    return add_write(access(r, range, Mode::write, is_image(r) ? Role::clear_dst : Role::fill_dst, 0), r, range);
  }

  // Histories get a final version, the surface a picture.
  void finish() {
    pass_ = {};
    pass_.name = "last", pass_.module = "random";
    pass_.kind = PassKind::compute;
    for (uint32_t r = 1; r < graph_.resources.size(); ++r)
      if (row(r).lifetime == Lifetime::history && !is_depth(r)) pass_.accesses.push_back(access(r, {}, Mode::write, Role::storage, stage_compute));
    if (!pass_.accesses.empty()) graph_.passes.add(pass_);
    for (uint32_t r = 1; r < graph_.resources.size(); ++r)
      if (row(r).lifetime == Lifetime::history && is_depth(r)) add_depth_history(r);
    pass_ = {};
    pass_.name = "show", pass_.module = "random";
    pass_.kind = PassKind::raster;
    add_reads(stage_fragment);
    Access picture = access(0, {}, Mode::write, Role::color, 0);
    picture.clear = ClearValue{};
    pass_.accesses.push_back(picture);
    graph_.passes.add(pass_);
  }
  void add_depth_history(uint32_t r) {
    pass_ = {};
    pass_.name = "last_depth", pass_.module = "random";
    pass_.kind = PassKind::raster;
    Access a = access(r, {}, Mode::write, Role::depth, 0);
    a.clear = ClearValue{};
    pass_.accesses.push_back(a);
    if (row(r).format == Format::d32f_s8) {
      Access s = access(r, {}, Mode::write, Role::stencil, 0);
      s.clear = ClearValue{};
      pass_.accesses.push_back(s);
    }
    graph_.passes.add(pass_);
  }

  std::mt19937_64 random_, queues_;
  RandomShape shape_;
  uint32_t shared_ = 0;  // resources that any pass may use, the first ones
  Program program_;
  Graph graph_;
  Pass pass_;
  std::vector<std::vector<bool>> defined_;  // by resource, then mip * layers + layer
};

}  // namespace

dsl::Program make_random_program(uint64_t seed, const RandomShape& shape) { return Generator(seed, shape).make(); }

}  // namespace rg::verify
