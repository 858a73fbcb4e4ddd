// Transfer statements: each brings its accesses and a row of Pass::transfers.
#include <algorithm>

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

bool report_formats(Checker& checker, DiagnosticKind kind, const Resource& from, const Resource& to, Span span) {
  checker.report(kind, span, {from.name, name(from.format), to.name, name(to.format)});
  return false;
}

struct Between {
  Checker& checker;
  const GraphScope& scope;
  const TransferWord& word;
  const Place &src, &dst;
  Span span;
  bool linear = false;
  const Resource& from() const { return scope.graph.resources[src.resource]; }
  const Resource& to() const { return scope.graph.resources[dst.resource]; }
};

bool samples_fit(const Between& at) {
  for (const Resource* image : {&at.from(), &at.to()}) {
    if (image->kind != ResourceKind::image || image->samples == 1) continue;
    at.checker.report(DiagnosticKind::TransferSamples, at.span, {std::string(at.word.word), image->name, std::to_string(image->samples)});
    return false;
  }
  return true;
}

uint32_t aspects_of(const Resource& image, const Range& range) { return range.aspects == 0 ? info(image.format).aspects : range.aspects; }

std::string aspects_text(const Resource& resource, const Range& range) {
  if (resource.kind == ResourceKind::buffer) return "is a buffer";
  const uint32_t aspects = aspects_of(resource, range);
  if (aspects == (aspect_depth | aspect_stencil)) return "has depth and stencil";
  return aspects == aspect_depth ? "has depth" : aspects == aspect_stencil ? "has stencil" : "has colours";
}

// Between images they go one to one, to and from buffers one at a time.
bool aspects_fit(const Between& at) {
  const Resource &from = at.from(), &to = at.to();
  const uint32_t src = aspects_of(from, at.src.range), dst = aspects_of(to, at.dst.range);
  const bool both_images = from.kind == to.kind && from.kind == ResourceKind::image;
  const auto one = [](uint32_t aspects) { return (aspects & (aspects - 1)) == 0; };
  if (both_images ? src == dst : one(src) && one(dst)) return true;
  at.checker.report(DiagnosticKind::TransferAspects, at.span,
                    {std::string(at.word.word), from.name, aspects_text(from, at.src.range), to.name, aspects_text(to, at.dst.range)});
  return false;
}

bool resolve_fits(const Between& at) {
  const Resource &from = at.from(), &to = at.to();
  if (from.samples == 1 || to.samples != 1) {
    at.checker.report(DiagnosticKind::ResolveSamples, at.span, {from.name, std::to_string(from.samples), to.name, std::to_string(to.samples)});
    return false;
  }
  return from.format == to.format || report_formats(at.checker, DiagnosticKind::ResolveFormats, from, to, at.span);
}

bool filter_fits(const Between& at) {
  const FormatInfo& format = info(at.from().format);
  const char* fault = !format.is_color() ? "depth and stencil are not mixed" : format.is_integer() ? "integers are not mixed" : nullptr;
  if (!at.linear || !fault) return true;
  at.checker.report(DiagnosticKind::BlitFilter, at.span, {at.from().name, format.name, fault});
  return false;
}

// No device draws blocks, so none scales into them.
bool blit_target_fits(const Between& at) {
  const FormatInfo& format = info(at.to().format);
  if (format.is_block()) at.checker.report(DiagnosticKind::BlockFormatUse, at.span, {at.to().name, format.name, "be blitted to"});
  return !format.is_block();
}

bool images_blit(const Between& at) {
  if (!samples_fit(at) || !blit_target_fits(at)) return false;
  if (!blit_fits(at.from().format, at.to().format)) return report_formats(at.checker, DiagnosticKind::BlitFormats, at.from(), at.to(), at.span);
  return filter_fits(at) && aspects_fit(at);
}

// Formats of depth are compatible with themselves alone.
bool images_copy(const Between& at) {
  const Resource &from = at.from(), &to = at.to();
  const bool colours = info(from.format).is_color() && info(to.format).is_color();
  const bool texels = from.format == to.format || (colours && info(from.format).block_bytes == info(to.format).block_bytes);
  if (!texels || from.samples != to.samples) return report_formats(at.checker, DiagnosticKind::CopyFormats, from, to, at.span);
  return aspects_fit(at);
}

bool copy_fits(const Between& at) {
  const bool from_image = is_image(at.scope, at.src), to_image = is_image(at.scope, at.dst);
  if (from_image && to_image) return images_copy(at);
  if (!from_image && !to_image) return true;
  return samples_fit(at) && aspects_fit(at);
}

bool sources_fit(const Between& at) {
  if (at.src.resource == at.dst.resource && at.src.age == at.dst.age && at.src.range == at.dst.range) {
    at.checker.report(DiagnosticKind::TransferOntoItself, at.span, {at.from().name});
    return false;
  }
  if (!kinds_fit(at.checker, at.scope, at.word, at.src, at.span)) return false;
  const bool fits = at.word.kind == TransferKind::resolve ? resolve_fits(at) : at.word.kind == TransferKind::blit ? images_blit(at) : copy_fits(at);
  return fits && sizes_fit(at.checker, at.scope, at.word.kind, at.src, at.dst, at.span);
}

bool target_fits(Checker& checker, const GraphScope& scope, const TransferWord& word, const Place& dst, Span span) {
  const Resource& to = scope.graph.resources[dst.resource];
  if (word.kind == TransferKind::fill) return fill_fits(checker, to, dst.range, span);
  if (word.kind != TransferKind::clear || !info(to.format).is_block()) return true;
  checker.report(DiagnosticKind::BlockFormatUse, span, {to.name, name(to.format), "be cleared"});
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
bool resolves_aspects(const Between& at, const PassScope& out) {
  const Resource &from = at.from(), &to = at.to();
  const FormatInfo& format = info(from.format);
  if (at.word.kind != TransferKind::resolve || format.is_color()) return true;
  const bool both = format.aspects == (aspect_depth | aspect_stencil);
  const std::string depth = both ? ".depth" : "", way = from.name + depth + " -> " + to.name + depth;
  if (out.pass.kind == PassKind::transfer) {
    at.checker.report(DiagnosticKind::ResolveOfDepth, at.span, {from.name, name(from.format), from.name + depth, to.name + depth});
    return false;
  }
  if (aspects_of(from, at.src.range) == aspect_depth && aspects_of(to, at.dst.range) == aspect_depth) return true;
  const auto& accesses = out.pass.accesses;
  const bool draws_depth = std::any_of(accesses.begin(), accesses.end(),
                                       [&](const Access& access) { return access.resource == at.src.resource && access.role == Role::depth; });
  at.checker.report(
      DiagnosticKind::ResolveOfStencil, at.span,
      {from.name, name(from.format),
       draws_depth && at.src.range.aspects != aspect_stencil ? "say `resolve " + way + "`" : "read the samples of its stencil in a shader"});
  return false;
}

void drop(GraphScope& scope, PassScope& out) { out.dropped = scope.incomplete = true; }

void finish(Checker& checker, GraphScope& scope, PassScope& out, const TransferWord& word, const ast::TransferStatement& node, Transfer transfer,
            const Place& dst) {
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
  if (!kinds_fit(checker, scope, *word, dst, node.span) || !check_writable(checker, scope, dst, *node.dst)) return drop(scope, out);
  if (!target_fits(checker, scope, *word, dst, node.span)) return drop(scope, out);
  if (node.src) {
    const Between between{checker, scope, *word, src, dst, node.span, node.linear};
    if (!sources_fit(between) || !resolves_aspects(between, out)) return drop(scope, out);
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
