// Whether a transfer has something for all that it writes, and stays inside both of its sides, at every choice of extents.
#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

using Extents = std::vector<int64_t>;

struct Half {
  const Resource& resource;
  const Range& range;
  bool is_image() const { return resource.kind == ResourceKind::image; }
};
struct Move {
  Checker& checker;
  TransferKind kind;
  Half src, dst;
  Span span;
  std::vector<ExprId> exprs;  // that sizes depend on
};

void add_exprs(const Half& half, std::vector<ExprId>& exprs) {
  if (half.is_image())
    exprs.insert(exprs.end(), {half.resource.width, half.resource.height, half.resource.depth});
  else
    exprs.insert(exprs.end(), {half.resource.count, half.range.offset, half.range.size});
}

int64_t base_of(const Checker& checker, ExprId axis, const Extents& extents) {
  return axis.valid() ? std::max<int64_t>(evaluate(checker.program, axis, extents), 1) : 1;
}

int64_t side_of(const Checker& checker, ExprId axis, uint32_t mip, const Extents& extents) {
  return std::max<int64_t>(base_of(checker, axis, extents) >> mip, 1);
}

bool has_mip(const Checker& checker, const Resource& image, uint32_t mip, const Extents& extents) {
  const auto longest =
      std::max({base_of(checker, image.width, extents), base_of(checker, image.height, extents), base_of(checker, image.depth, extents)});
  return longest >> mip > 0;
}

// A pass runs where its images have the mips that it names.
bool runs(const Move& move, const Extents& extents) {
  const auto exists = [&](const Half& half) { return !half.is_image() || has_mip(move.checker, half.resource, half.range.mip, extents); };
  return exists(move.src) && exists(move.dst);
}

std::array<int64_t, 3> blocks_of(const Checker& checker, const Resource& image, uint32_t mip, const Extents& extents) {
  const FormatInfo& format = info(image.format);
  const int64_t width = side_of(checker, image.width, mip, extents), height = side_of(checker, image.height, mip, extents);
  return {(width + format.block_width - 1) / format.block_width, (height + format.block_height - 1) / format.block_height,
          side_of(checker, image.depth, mip, extents)};
}

uint32_t aspects_of(const Half& half) { return half.range.aspects == 0 ? info(half.resource.format).aspects : half.range.aspects; }

// A texel, or block, of one aspect as buffers hold it.
int64_t block_bytes(const Half& image) {
  constexpr int64_t kShallow = 2, kDeep = 4;  // deeper ones take a word, whatever lies beside them in the image
  if (aspects_of(image) == aspect_stencil) return 1;
  if (aspects_of(image) == aspect_depth) return image.resource.format == Format::d16 ? kShallow : kDeep;
  return info(image.resource.format).block_bytes;
}

// Of each mip that there is, all layers.
std::vector<int64_t> mip_bytes(const Checker& checker, const Half& image, const Extents& extents) {
  std::vector<int64_t> bytes;
  const Range& range = image.range;
  for (uint32_t mip = range.mip; mip < range.mip + mip_count(image.resource, range) && has_mip(checker, image.resource, mip, extents); ++mip) {
    const auto blocks = blocks_of(checker, image.resource, mip, extents);
    bytes.push_back(blocks[0] * blocks[1] * blocks[2] * layer_count(image.resource, range) * block_bytes(image));
  }
  return bytes;
}

int64_t bytes_of(const Checker& checker, const Half& half, const Extents& extents) {
  if (half.is_image()) {
    const auto mips = mip_bytes(checker, half, extents);
    return std::accumulate(mips.begin(), mips.end(), int64_t{0});
  }
  if (half.range.size.valid()) return evaluate(checker.program, half.range.size, extents);
  return evaluate(checker.program, half.resource.count, extents) * int64_t{half.resource.stride};
}

std::string size_text(const Checker& checker, const Half& half, const Extents& extents) {
  if (!half.is_image()) return std::to_string(bytes_of(checker, half, extents)) + " bytes";
  const Resource& image = half.resource;
  std::string text = std::to_string(side_of(checker, image.width, half.range.mip, extents));
  for (const ExprId axis : {image.height, image.depth})
    if (axis.valid()) text += "x" + std::to_string(side_of(checker, axis, half.range.mip, extents));
  if (const uint32_t mips = mip_count(image, half.range); mips > 1) text += ", " + std::to_string(mips) + " mips";
  if (const uint32_t layers = layer_count(image, half.range); layers > 1) text += ", " + std::to_string(layers) + " layers";
  return text;
}

bool report_rest(const Move& move, const Extents& extents, std::string way_out) {
  const Checker& checker = move.checker;
  std::string has = size_text(checker, move.src, extents) + where_extents(checker.program, move.exprs, extents);
  move.checker.report(DiagnosticKind::CopyTooSmall, move.span,
                      {move.src.resource.name, std::move(has), move.dst.resource.name, size_text(checker, move.dst, extents), std::move(way_out)});
  return false;
}

// ---- images -----------------------------------------------------------------------------------------------------

bool image_covers(const Move& move, const Extents& extents) {
  const auto& [from, src] = move.src;
  const auto& [to, dst] = move.dst;
  const uint32_t mips = mip_count(to, dst);
  if (mip_count(from, src) < mips || layer_count(from, src) < layer_count(to, dst)) return false;
  for (uint32_t i = 0; i < mips && move.kind != TransferKind::blit; ++i) {  // a blit scales
    if (!has_mip(move.checker, to, dst.mip + i, extents)) break;
    if (!has_mip(move.checker, from, src.mip + i, extents)) return false;
    const auto has = blocks_of(move.checker, from, src.mip + i, extents), wants = blocks_of(move.checker, to, dst.mip + i, extents);
    if (!std::equal(wants.begin(), wants.end(), has.begin(), std::less_equal<>())) return false;
  }
  return true;
}

bool images_fit(const Move& move, const Extents& extents) {
  if (image_covers(move, extents)) return true;
  return report_rest(move, extents,
                     move.kind == TransferKind::copy      ? "`blit` scales"
                     : move.kind == TransferKind::resolve ? "a resolve keeps the size"
                                                          : "layers are not scaled: name as many, `.layers(first, count)`");
}

// vkCmdCopyImage makes layers of slices, but a range here counts one or the other; it takes one axis to one axis.
const char* shape_of(const Resource& image, const Resource& other) {
  if (image.dimension == Dimension::d3) return "slices";
  if (image.dimension == Dimension::d1) return "one axis";
  return other.dimension == Dimension::d1 ? "two axes" : "layers";
}

bool shapes_fit(const Move& move, const char* verb) {
  const Resource &from = move.src.resource, &to = move.dst.resource;
  const bool same_depth = (from.dimension == Dimension::d3) == (to.dimension == Dimension::d3);
  const bool same_line = (from.dimension == Dimension::d1) == (to.dimension == Dimension::d1);
  const auto first_layer = [](const Half& half) { return half.range.layer == 0 && layer_count(half.resource, half.range) == 1; };
  const bool scales = move.kind == TransferKind::blit;  // depth, too, and what has one layer has the depth 1
  const bool fits = scales ? same_depth || (first_layer(move.src) && first_layer(move.dst)) : same_depth && same_line;
  if (!fits) move.checker.report(DiagnosticKind::TransferShapes, move.span, {verb, from.name, shape_of(from, to), to.name, shape_of(to, from)});
  return fits;
}

// ---- buffers ----------------------------------------------------------------------------------------------------

// Images lie in buffers without gaps, mip after mip.
bool bytes_fit(const Move& move, const Extents& extents) {
  const int64_t has = bytes_of(move.checker, move.src, extents), wants = bytes_of(move.checker, move.dst, extents);
  const bool beyond = move.src.is_image() ? has > wants : move.dst.is_image() && has < wants;
  if (beyond) {
    const Half &image = move.src.is_image() ? move.src : move.dst, &buffer = move.src.is_image() ? move.dst : move.src;
    move.checker.report(DiagnosticKind::CopyBeyondBuffer, move.span,
                        {image.resource.name, std::to_string(bytes_of(move.checker, image, extents)), buffer.resource.name,
                         std::to_string(bytes_of(move.checker, buffer, extents)), where_extents(move.checker.program, move.exprs, extents)});
    return false;
  }
  if (has >= wants) return true;
  return report_rest(move, extents, "name the bytes that it gets, `" + move.dst.resource.name + ".bytes(offset, size)`");
}

// Each mip of the image begins at a whole texel, and at a whole word if it is of depth or stencil, which may be narrower.
bool offsets_fit(const Move& move, const Half& buffer, const Half& image, const Extents& extents) {
  constexpr int64_t kWord = 4;
  const int64_t step = info(image.resource.format).is_color() ? block_bytes(image) : kWord;
  int64_t offset = buffer.range.offset.valid() ? evaluate(move.checker.program, buffer.range.offset, extents) : 0;
  for (const int64_t bytes : mip_bytes(move.checker, image, extents)) {
    if (offset % step != 0) {
      move.checker.report(DiagnosticKind::TransferAlignment, move.span,
                          {"copy", "an offset", std::to_string(step), buffer.resource.name, std::to_string(bytes), std::to_string(offset)});
      return false;
    }
    offset += bytes;
  }
  return true;
}

// Nobody knows how long a buffer is that the host sizes.
bool is_sized(const Half& half) { return half.is_image() || half.range.size.valid() || half.resource.count.valid(); }

bool fits_at(const Move& move, const Extents& extents) {
  if (!runs(move, extents)) return true;
  if (move.src.is_image() && move.dst.is_image()) return images_fit(move, extents);
  if (move.dst.is_image() && !offsets_fit(move, move.src, move.dst, extents)) return false;
  if (move.src.is_image() && !offsets_fit(move, move.dst, move.src, extents)) return false;
  return !is_sized(move.src) || !is_sized(move.dst) || bytes_fit(move, extents);
}

}  // namespace

bool sizes_fit(Checker& checker, const GraphScope& scope, TransferKind kind, const Place& src, const Place& dst, Span span) {
  Move move{checker, kind, {scope.graph.resources[src.resource], src.range}, {scope.graph.resources[dst.resource], dst.range}, span, {}};
  add_exprs(move.src, move.exprs);
  add_exprs(move.dst, move.exprs);
  const char* verb = kind == TransferKind::copy ? "copy" : kind == TransferKind::blit ? "blit" : "resolve";
  if (move.src.is_image() && move.dst.is_image() && !shapes_fit(move, verb)) return false;
  const auto telling = telling_extents(checker.program, move.exprs);
  return std::all_of(telling.begin(), telling.end(), [&](const Extents& extents) { return fits_at(move, extents); });
}

bool fill_fits(Checker& checker, const Resource& buffer, const Range& range, Span span) {
  constexpr int64_t kWord = 4;
  const Half half{buffer, range};
  if (!is_sized(half)) return true;
  std::vector<ExprId> exprs;
  add_exprs(half, exprs);
  for (const Extents& extents : telling_extents(checker.program, exprs)) {
    const int64_t offset = range.offset.valid() ? evaluate(checker.program, range.offset, extents) : 0, size = bytes_of(checker, half, extents);
    if (offset % kWord == 0 && size % kWord == 0) continue;
    checker.report(DiagnosticKind::TransferAlignment, span,
                   {"fill", "offset and size", std::to_string(kWord), buffer.name, std::to_string(size), std::to_string(offset)});
    return false;
  }
  return true;
}

}  // namespace rg::dsl
