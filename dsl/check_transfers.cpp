// Transfer statements: each brings its accesses and a row of Pass::transfers.
#include <algorithm>
#include <array>
#include <functional>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

struct TransferWord {
  std::string_view word;
  TransferKind kind;
  Role src, dst;
};
constexpr TransferWord kTransfers[] = {{"copy", TransferKind::copy, Role::copy_src, Role::copy_dst},
                                       {"blit", TransferKind::blit, Role::blit_src, Role::blit_dst},
                                       {"resolve", TransferKind::resolve, Role::resolve_src, Role::resolve_dst},
                                       {"clear", TransferKind::clear, Role::undefined, Role::clear_dst},
                                       {"fill", TransferKind::fill, Role::undefined, Role::fill_dst},
                                       {"update", TransferKind::update, Role::undefined, Role::update_dst}};

bool is_image(const GraphScope& scope, const Place& place) { return scope.graph.resources[place.resource].kind == ResourceKind::image; }

// Copies of part of a level are not expressible, so a transfer defines its range.
bool kinds_fit(Checker& checker, const GraphScope& scope, const TransferWord& word, const Place& dst, Span span) {
  const Resource& resource = scope.graph.resources[dst.resource];
  const bool image = is_image(scope, dst);
  const bool wants_image = word.kind == TransferKind::clear || word.kind == TransferKind::blit || word.kind == TransferKind::resolve;
  const bool wants_buffer = word.kind == TransferKind::fill || word.kind == TransferKind::update;
  if (!(wants_image && !image) && !(wants_buffer && image)) return true;
  checker.report(DiagnosticKind::TransferOfKind, span, {std::string(word.word), image ? "an image" : "a buffer", resource.name})
      .note(DiagnosticKind::DeclaredHere, resource.span, {resource.name});
  return false;
}

// What vkCmdBlitImage converts.
bool blit_fits(Format from, Format to) {
  const FormatInfo &a = info(from), &b = info(to);
  if (!a.is_color() || !b.is_color()) return from == to;
  const auto kind = [](const FormatInfo& format) { return format.is_integer() ? format.numeric : Numeric::floating; };
  return kind(a) == kind(b);
}

int64_t side_of(const Checker& checker, ExprId axis, uint32_t mip, const std::vector<int64_t>& extents) {
  return axis.valid() ? std::max<int64_t>(evaluate(checker.program, axis, extents) >> mip, 1) : 1;
}

// What copies count: blocks along each axis of the first mip, then mips, then layers.
std::array<int64_t, 5> blocks_of(const Checker& checker, const Resource& image, const Range& range, const std::vector<int64_t>& extents) {
  const FormatInfo& format = info(image.format);
  const int64_t width = side_of(checker, image.width, range.mip, extents), height = side_of(checker, image.height, range.mip, extents);
  return {(width + format.block_width - 1) / format.block_width, (height + format.block_height - 1) / format.block_height,
          side_of(checker, image.depth, range.mip, extents), mip_count(image, range), layer_count(image, range)};
}

std::string size_text(const Checker& checker, const Resource& image, const Range& range, const std::vector<int64_t>& extents) {
  std::string text = std::to_string(side_of(checker, image.width, range.mip, extents));
  for (const ExprId axis : {image.height, image.depth})
    if (axis.valid()) text += "x" + std::to_string(side_of(checker, axis, range.mip, extents));
  if (const uint32_t mips = mip_count(image, range); mips > 1) text += ", " + std::to_string(mips) + " mips";
  if (const uint32_t layers = layer_count(image, range); layers > 1) text += ", " + std::to_string(layers) + " layers";
  return text;
}

// A transfer defines what it writes, so there has to be a texel of the source for each.
bool source_covers(Checker& checker, const GraphScope& scope, const TransferWord& word, const Place& src, const Place& dst, Span span) {
  const Resource &from = scope.graph.resources[src.resource], &to = scope.graph.resources[dst.resource];
  if (from.dimension != to.dimension) return true;
  for (const auto& extents : {initial_extents(checker.program), maximum_extents(checker.program)}) {
    const auto has = blocks_of(checker, from, src.range, extents), wants = blocks_of(checker, to, dst.range, extents);
    if (std::equal(wants.begin(), wants.end(), has.begin(), std::less_equal<>())) continue;
    checker.report(DiagnosticKind::CopyTooSmall, span,
                   {from.name, size_text(checker, from, src.range, extents), to.name, size_text(checker, to, dst.range, extents),
                    word.kind == TransferKind::copy ? "`blit` scales" : "a resolve keeps the size"});
    return false;
  }
  return true;
}

bool sources_fit(Checker& checker, const GraphScope& scope, const TransferWord& word, const Place& src, const Place& dst, Span span) {
  const Resource &from = scope.graph.resources[src.resource], &to = scope.graph.resources[dst.resource];
  if (src.resource == dst.resource && src.age == dst.age && src.range == dst.range) {
    checker.report(DiagnosticKind::TransferOntoItself, span, {from.name});
    return false;
  }
  if (word.kind == TransferKind::resolve && (from.samples == 1 || to.samples != 1)) {
    checker.report(DiagnosticKind::ResolveSamples, span, {from.name, std::to_string(from.samples), to.name, std::to_string(to.samples)});
    return false;
  }
  if (word.kind == TransferKind::resolve && from.format != to.format) {
    checker.report(DiagnosticKind::ResolveFormats, span, {from.name, name(from.format), to.name, name(to.format)});
    return false;
  }
  if (word.kind == TransferKind::resolve) return source_covers(checker, scope, word, src, dst, span);
  if (word.kind == TransferKind::blit && is_image(scope, src) && is_image(scope, dst) && !blit_fits(from.format, to.format)) {
    checker.report(DiagnosticKind::BlitFormats, span, {from.name, name(from.format), to.name, name(to.format)});
    return false;
  }
  const bool both_images = is_image(scope, src) && is_image(scope, dst);
  if (word.kind != TransferKind::copy || !both_images) return kinds_fit(checker, scope, word, src, span);
  if (info(from.format).block_bytes == info(to.format).block_bytes && from.samples == to.samples)
    return source_covers(checker, scope, word, src, dst, span);
  checker.report(DiagnosticKind::CopyFormats, span, {from.name, name(from.format), to.name, name(to.format)});
  return false;
}

// In a raster pass the source is the attachment itself.
std::optional<uint32_t> find_attachment(Checker& checker, const GraphScope& scope, const PassScope& out, const Place& src) {
  const auto& accesses = out.pass.accesses;
  const auto at = std::find_if(accesses.begin(), accesses.end(), [&](const Access& access) {
    return access.resource == src.resource && (access.role == Role::color || access.role == Role::depth);
  });
  if (at != accesses.end()) return static_cast<uint32_t>(at - accesses.begin());
  checker.report(DiagnosticKind::ResolveOfOther, src.span, {scope.graph.resources[src.resource].name, out.pass.name});
  return std::nullopt;
}

std::optional<uint32_t> add_source(Checker& checker, GraphScope& scope, PassScope& out, const TransferWord& word, const Place& src) {
  if (out.pass.kind == PassKind::raster) return find_attachment(checker, scope, out, src);
  return add_plain_access(scope, out, src, Mode::read, word.src);
}

bool belongs(Checker& checker, const PassScope& out, const TransferWord& word, Span span) {
  const bool fits = out.pass.kind == PassKind::transfer || (out.pass.kind == PassKind::raster && word.kind == TransferKind::resolve);
  if (!fits) checker.report(DiagnosticKind::TransferOutsideTransfer, span, {std::string(word.word)});
  return fits;
}

// vkCmdResolveImage knows no other aspect than colour (VUID-VkImageResolve-aspectMask-00266); renderings resolve depth, too.
bool resolves_aspects(Checker& checker, const GraphScope& scope, const PassScope& out, const TransferWord& word, const Place& src, const Place& dst,
                      Span span) {
  const Resource &from = scope.graph.resources[src.resource], &to = scope.graph.resources[dst.resource];
  const FormatInfo& format = info(from.format);
  if (word.kind != TransferKind::resolve || format.is_color()) return true;
  const bool both = format.aspects == (aspect_depth | aspect_stencil);
  const std::string depth = both ? ".depth" : "", way = from.name + depth + " -> " + to.name + depth;
  if (out.pass.kind == PassKind::transfer) {
    checker.report(DiagnosticKind::ResolveOfDepth, span, {from.name, name(from.format), from.name + depth, to.name + depth});
    return false;
  }
  const auto of_depth = [&](const Place& place) { return (place.range.aspects ? place.range.aspects : format.aspects) == aspect_depth; };
  if (of_depth(src) && of_depth(dst)) return true;
  const auto& accesses = out.pass.accesses;
  const bool draws_depth = std::any_of(accesses.begin(), accesses.end(),
                                       [&](const Access& access) { return access.resource == src.resource && access.role == Role::depth; });
  checker.report(DiagnosticKind::ResolveOfStencil, span,
                 {from.name, name(from.format),
                  draws_depth && src.range.aspects != aspect_stencil ? "say `resolve " + way + "`" : "read the samples of its stencil in a shader"});
  return false;
}

void drop(GraphScope& scope, PassScope& out) { out.dropped = scope.incomplete = true; }

void finish(Checker& checker, GraphScope& scope, PassScope& out, const TransferWord& word, const ast::TransferStatement& node, Transfer transfer,
            const Place& dst) {
  if (!check_writable(checker, scope, dst, *node.dst)) return drop(scope, out);
  transfer.dst = add_plain_access(scope, out, dst, Mode::write, word.dst);
  if (dst.port) dst.port->written = true;
  const Access& access = out.pass.accesses[transfer.dst];
  if (node.value) transfer.value = clear_value(checker, scope, *node.value, scope.graph.resources[dst.resource], access.range.aspects);
  if (word.kind == TransferKind::update) transfer.data = access.name;
  if (node.linear) transfer.filter = Filter::linear;
  out.pass.transfers.push_back(std::move(transfer));
}

}  // namespace

void add_transfer(Checker& checker, GraphScope& scope, PassScope& out, const ast::TransferStatement& node) {
  const auto* word = std::find_if(std::begin(kTransfers), std::end(kTransfers), [&](const TransferWord& row) { return row.word == node.verb.text; });
  if (word == std::end(kTransfers) || !node.dst) return drop(scope, out);
  Transfer transfer;
  transfer.kind = word->kind;
  if (!belongs(checker, out, *word, node.span)) return drop(scope, out);
  const Place src = node.src ? find_place(checker, scope, *node.src) : Place{};
  const Place dst = find_place(checker, scope, *node.dst);
  if (!dst.ok() || (node.src && !src.ok())) return drop(scope, out);
  if (!kinds_fit(checker, scope, *word, dst, node.span)) return drop(scope, out);
  if (node.src) {
    if (!sources_fit(checker, scope, *word, src, dst, node.span) || !resolves_aspects(checker, scope, out, *word, src, dst, node.span))
      return drop(scope, out);
    const auto from = add_source(checker, scope, out, *word, src);
    if (!from) return drop(scope, out);
    transfer.src = *from;
  }
  finish(checker, scope, out, *word, node, std::move(transfer), dst);
}

void add_host_transfer(Checker& checker, GraphScope& scope, PassScope& out, const ast::HostTransfer& node) {
  if (out.pass.kind != PassKind::transfer) {
    checker.report(DiagnosticKind::TransferOutsideTransfer, node.span, {"host"});
    return drop(scope, out);
  }
  Transfer transfer;
  transfer.kind = TransferKind::host;
  for (const ast::AccessStatement& statement : node.accesses) {
    const auto index = add_access(checker, scope, out, statement);
    if (!index) return;
    uint32_t& slot = statement.verb == ast::Verb::read ? transfer.src : transfer.dst;
    if (slot == kAll) slot = *index;
  }
  out.pass.transfers.push_back(std::move(transfer));
}

}  // namespace rg::dsl
