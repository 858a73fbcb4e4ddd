// `read | write | update | atomic RES as ROLE in STAGES`, `color`, `depth`, `stencil`: rows of Pass::accesses.
#include <algorithm>
#include <set>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

using ast::AccessStatement;
using ast::Verb;

struct Builder {
  Checker& checker;
  GraphScope& scope;
  PassScope& out;
  const AccessStatement& node;
  Access access;
  const Resource* resource = nullptr;
  bool ok = true;
};

void fail(Builder& at, DiagnosticKind kind, Span span, std::vector<std::string> arguments = {}) {
  at.checker.report(kind, span, std::move(arguments));
  at.ok = false;
}

const char* word_of(Verb verb) {
  constexpr const char* kWords[] = {"read", "write", "update", "atomic", "color", "depth", "stencil"};
  return kWords[static_cast<size_t>(verb)];
}

bool is_attachment(Verb verb) { return verb == Verb::color || verb == Verb::depth || verb == Verb::stencil; }

struct BlendWord {
  std::string_view word;
  BlendFactor factor;
};
constexpr BlendWord kFactors[] = {{"zero", BlendFactor::zero},           {"one", BlendFactor::one},
                                  {"src_alpha", BlendFactor::src_alpha}, {"one_minus_src_alpha", BlendFactor::one_minus_src_alpha},
                                  {"dst_alpha", BlendFactor::dst_alpha}, {"one_minus_dst_alpha", BlendFactor::one_minus_dst_alpha},
                                  {"src_color", BlendFactor::src_color}, {"one_minus_src_color", BlendFactor::one_minus_src_color},
                                  {"dst_color", BlendFactor::dst_color}, {"one_minus_dst_color", BlendFactor::one_minus_dst_color}};
struct BlendOpWord {
  std::string_view word;
  BlendOp op;
};
constexpr BlendOpWord kBlendOps[] = {{"add", BlendOp::add},
                                     {"subtract", BlendOp::subtract},
                                     {"reverse_subtract", BlendOp::reverse_subtract},
                                     {"min", BlendOp::min},
                                     {"max", BlendOp::max}};

template <class Row, size_t Count>
const Row* find_word(Builder& at, const ast::Name& name, const Row (&rows)[Count], const char* what) {
  std::vector<std::string_view> candidates;
  for (const Row& row : rows) {
    if (row.word == name.text) return &row;
    candidates.push_back(row.word);
  }
  at.ok = false;
  if (name.empty()) return nullptr;
  Diagnostic diagnostic(DiagnosticKind::UnknownBlendWord, name.span, {std::string(name.text), what});
  const Guess guess = closest(name.text, candidates);
  suggest(diagnostic, name.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  return nullptr;
}

void read_blend(Builder& at) {
  if (!at.node.blend) return;
  const ast::BlendOption& node = *at.node.blend;
  Blend blend;
  blend.enabled = true;
  if (const auto* op = find_word(at, node.op, kBlendOps, "blend operation")) blend.op = op->op;
  if (node.factors.size() != 2 && node.factors.size() != 4)
    return fail(at, DiagnosticKind::BlendFactorCount, node.span, {std::to_string(node.factors.size())});
  BlendFactor factors[4] = {};
  for (size_t i = 0; i < node.factors.size(); ++i)
    if (const auto* factor = find_word(at, node.factors[i], kFactors, "blend factor")) factors[i] = factor->factor;
  const size_t alpha = node.factors.size() == 4 ? 2 : 0;
  blend.src = factors[0];
  blend.dst = factors[1];
  blend.src_alpha = factors[alpha];
  blend.dst_alpha = factors[alpha + 1];
  at.access.blend = blend;
}

Role default_role(const Builder& at) {
  if (at.node.verb == Verb::color) return Role::color;
  if (at.node.verb == Verb::depth) return at.node.readonly ? Role::depth_readonly : Role::depth;
  if (at.node.verb == Verb::stencil) return Role::stencil;
  return Role::storage;
}

void report_unknown_role(Builder& at, const ast::Name& word) {
  Diagnostic diagnostic(DiagnosticKind::UnknownRole, word.span, {std::string(word.text)});
  const Guess guess =
      closest(word.text, {"sampled", "storage", "uniform", "vertex", "index", "indirect", "input", "copy_src", "copy_dst", "element"});
  suggest(diagnostic, word.span, guess);
  at.checker.diagnostics.report(std::move(diagnostic));
  at.ok = false;
}

// What is only read need not be storage: any image can be fetched from.
void read_element(Builder& at) {
  at.access.element = true;
  const bool fetched = at.node.verb == Verb::read && at.resource->kind == ResourceKind::image;
  at.access.role = fetched ? Role::sampled : Role::storage;
  if (at.node.verb == Verb::atomic) fail(at, DiagnosticKind::RoleDirection, at.node.usage->role.span, {word_of(at.node.verb), "element"});
}

void read_role(Builder& at) {
  const bool host_pass = at.out.pass.kind == PassKind::host;
  if (is_attachment(at.node.verb) || !at.node.usage) {
    at.access.role = default_role(at);
    if (host_pass) at.access.role = at.node.verb == Verb::read ? Role::host_read : Role::host_write;
    const bool needs_role = !is_attachment(at.node.verb) && at.node.verb != Verb::atomic && !host_pass;
    const char* roles = at.node.verb == Verb::read ? "`as sampled` or `as storage`" : "`as storage`";
    if (needs_role) fail(at, DiagnosticKind::RoleMissing, at.node.span, {word_of(at.node.verb), spelled(at.node.target), roles});
    return;
  }
  const ast::Name& word = at.node.usage->role;
  if (word.text == "element") return read_element(at);
  const auto role = find_role(word.text);
  if (!role) return word.empty() ? void(at.ok = false) : report_unknown_role(at, word);
  at.access.role = *role;
  if (word.text == "host") at.access.role = at.node.verb == Verb::read ? Role::host_read : Role::host_write;
  if (*role == Role::depth && at.node.verb == Verb::read) at.access.role = Role::depth_readonly;
}

bool writes_only(Role role) {
  switch (role) {
    case Role::copy_dst:
    case Role::blit_dst:
    case Role::resolve_dst:
    case Role::clear_dst:
    case Role::fill_dst:
    case Role::update_dst:
    case Role::host_write:
      return true;
    default:
      return false;
  }
}

void check_direction(Builder& at) {
  if (!at.node.usage || !at.ok) return;
  const Role role = at.access.role;
  const bool reads = at.node.verb == Verb::read;
  const bool wrong = (!reads && reads_only(role)) || (reads && writes_only(role)) || (at.node.verb == Verb::atomic && role != Role::storage) ||
                     role == Role::present || role == Role::undefined;
  if (wrong) fail(at, DiagnosticKind::RoleDirection, at.node.usage->role.span, {word_of(at.node.verb), std::string(at.node.usage->role.text)});
}

void read_sampler(Builder& at) {
  if (!at.node.usage || !at.node.usage->sampler) return;
  if (at.access.role != Role::sampled) return fail(at, DiagnosticKind::SamplerOfRole, at.node.usage->span, {std::string(at.node.usage->role.text)});
  const auto symbol = find_symbol(at.checker, at.scope.module, *at.node.usage->sampler, SymbolKind::sampler);
  if (!symbol) return void(at.ok = false);
  at.access.sampler = sampler_of(at.checker, *symbol);
}

// `write` and `clear` define the range; blending, and drawing that may leave holes, keep what was there.
Mode attachment_mode(const Builder& at) {
  if (at.node.readonly) return Mode::read;
  if (at.node.clear) return Mode::write;
  return at.node.covers && !at.node.blend ? Mode::write : Mode::update;
}

Mode mode_of(const Builder& at) {
  if (is_attachment(at.node.verb)) return attachment_mode(at);
  constexpr Mode kModes[] = {Mode::read, Mode::write, Mode::update, Mode::atomic};
  return kModes[static_cast<size_t>(at.node.verb)];
}

void check_options(Builder& at) {
  const bool attachment = is_attachment(at.node.verb);
  const auto refuse = [&](bool present, const char* option) {
    if (present) fail(at, DiagnosticKind::OptionDoesNotFit, at.node.span, {option, word_of(at.node.verb)});
  };
  refuse(at.node.blend && at.node.verb != Verb::color, "blend");
  refuse(at.node.readonly && at.node.verb != Verb::depth && at.node.verb != Verb::stencil, "readonly");
  refuse(at.node.clear && at.node.verb == Verb::read, "clear");
  refuse(at.node.covers && at.node.verb == Verb::read, "covers");
  refuse(at.node.disjoint && at.node.verb == Verb::read, "disjoint");
  refuse(at.node.usage && attachment, "as");
  refuse(!at.node.stages.empty() && attachment, "in");
  const bool twice = !at.node.stages.empty() && at.node.usage && !at.node.usage->stages.empty();
  if (twice) fail(at, DiagnosticKind::RepeatedSetting, at.node.stages.front().span, {"in"});
  refuse(at.node.readonly && at.node.clear, "clear");
  if (attachment && at.out.pass.kind != PassKind::raster) fail(at, DiagnosticKind::AttachmentOutsideRaster, at.node.span, {word_of(at.node.verb)});
}

void set_aspects(Builder& at) {
  if (at.resource->kind == ResourceKind::buffer || at.access.range.aspects != 0) return;
  const uint32_t has = info(at.resource->format).aspects;
  uint32_t& aspects = at.access.range.aspects;
  aspects = has;
  if (at.access.role == Role::depth || at.access.role == Role::depth_readonly) aspects = has & aspect_depth;
  if (at.access.role == Role::stencil) aspects = has & aspect_stencil;
  const bool one_aspect = is_shader_role(at.access.role) && (has & aspect_depth) != 0;
  if (one_aspect) aspects = aspect_depth;
  if (aspects == 0) aspects = has;
}

void limit_mips(PassScope& out, const Access& access) {
  if (access.range.mip == 0) return;
  const MipLimit limit{access.resource, access.range.mip};
  auto& limits = out.pass.mip_limits;
  if (std::find(limits.begin(), limits.end(), limit) == limits.end()) limits.push_back(limit);
}

void read_clear(Builder& at) {
  if (!at.node.clear || !at.ok) return;
  at.access.clear = clear_value(at.checker, at.scope, *at.node.clear, *at.resource, at.access.range.aspects);
  if (at.resource->kind == ResourceKind::buffer) at.ok = fill_fits(at.checker, *at.resource, at.access.range, at.node.clear->span);
}

void check_port(Builder& at, const Place& place) {
  if (!place.port || place.age > 0 || !at.ok) return;
  const bool needs_earlier = at.access.mode != Mode::write && !at.access.clear;
  const std::string name(place.port->name);
  if (needs_earlier && !place.port->written && at.out.pass.draw.kind != DrawKind::fullscreen)
    return at.checker.report(DiagnosticKind::PortReadFirst, at.node.span, {name}).note(DiagnosticKind::DeclaredHere, place.port->span, {name}),
           void(at.ok = false);
  if (at.access.mode != Mode::read) place.port->written = true;
}

uint32_t commit(PassScope& out, Access access) {
  limit_mips(out, access);
  out.pass.accesses.push_back(std::move(access));
  return static_cast<uint32_t>(out.pass.accesses.size() - 1);
}

bool same_range(const Access& a, const Access& b) {
  return a.resource == b.resource && a.age == b.age && a.range == b.range && a.role == b.role && a.view == b.view;
}

void merge_into(Access& first, const Access& second) {
  if (second.mode == Mode::read) return;
  const bool wrote_first = first.mode != Mode::read;
  first.disjoint |= second.disjoint;
  first.clear = second.clear;
  first.covers |= second.covers;
  if (!wrote_first) first.mode = Mode::update;
}

void move_indices(Pass& pass, const std::vector<uint32_t>& moved) {
  const auto map = [&](uint32_t& index) { index = index == kAll ? kAll : moved[index]; };
  map(pass.draw.arguments);
  map(pass.draw.counts);
  map(pass.dispatch.arguments);
  map(pass.masks);
  map(pass.kernels);
  for (Transfer& transfer : pass.transfers) map(transfer.src), map(transfer.dst);
}

const char* suffix_of(Role role) {
  constexpr const char* kSuffixes[] = {"_sampled", "_storage", "_uniform", "_vertex", "_index", "_indirect", "_color",   "_depth",
                                       "_depth",   "_stencil", "_input",   "_src",    "_dst",   "_src",      "_dst",     "_src",
                                       "_dst",     "_clear",   "_fill",    "_update", "_read",  "_write",    "_present", "_undefined"};
  return kSuffixes[static_cast<size_t>(role)];
}

}  // namespace

bool is_shader_role(Role role) { return role == Role::sampled || role == Role::storage || role == Role::uniform || role == Role::input; }
bool is_attachment(Role role) { return role == Role::color || role == Role::depth || role == Role::depth_readonly || role == Role::stencil; }
bool is_written(Mode mode) { return mode != Mode::read; }

std::optional<uint32_t> add_access(Checker& checker, GraphScope& scope, PassScope& out, const AccessStatement& statement) {
  Builder at{checker, scope, out, statement, {}, nullptr, true};
  const Place place = find_place(checker, scope, statement.target);
  if (!place.ok()) return out.dropped = true, std::nullopt;
  at.resource = &scope.graph.resources[place.resource];
  at.access.resource = place.resource;
  at.access.range = place.range;
  at.access.age = place.age;
  at.access.view = place.view;
  at.access.span = statement.span;
  at.access.name = statement.rename.empty() ? place.default_name : std::string(statement.rename.text);
  at.access.covers = statement.covers;
  at.access.disjoint = statement.disjoint;
  check_options(at);
  const bool reads = statement.verb == Verb::read || statement.readonly;
  if (!reads && !check_writable(checker, scope, place, statement.target)) at.ok = false;
  read_role(at);
  check_direction(at);
  if (at.ok) set_aspects(at);
  read_sampler(at);
  read_blend(at);
  read_clear(at);
  at.access.mode = mode_of(at);
  if (is_slice(at.access) && at.access.mode == Mode::write) at.access.mode = Mode::update;  // the other slices stay
  check_port(at, place);
  at.access.stages = find_stages(checker, statement.stages.empty() && statement.usage ? statement.usage->stages : statement.stages);
  if (!at.ok) return out.dropped = scope.incomplete = true, std::nullopt;
  return commit(out, std::move(at.access));
}

uint32_t add_plain_access(GraphScope& scope, PassScope& out, const Place& place, Mode mode, Role role) {
  Access access;
  access.resource = place.resource;
  access.range = place.range;
  access.age = place.age;
  access.view = place.view;
  access.mode = mode;
  access.role = role;
  access.name = place.default_name;
  access.span = place.span;
  const Resource& resource = scope.graph.resources[place.resource];
  if (resource.kind == ResourceKind::image && access.range.aspects == 0) access.range.aspects = info(resource.format).aspects;
  return commit(out, std::move(access));
}

// A `read` and a `write` of one range under one name are one `update`.
void merge_reads_and_writes(Pass& pass) {
  std::vector<Access> kept;
  std::vector<uint32_t> moved;
  for (Access& access : pass.accesses) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const Access& other) {
      const bool pair = (other.mode == Mode::read) != (access.mode == Mode::read) && access.mode != Mode::atomic && other.mode != Mode::atomic;
      return pair && is_shader_role(access.role) && same_range(other, access) && other.name == access.name;
    });
    moved.push_back(static_cast<uint32_t>(twin == kept.end() ? kept.size() : static_cast<size_t>(twin - kept.begin())));
    if (twin == kept.end()) {
      kept.push_back(std::move(access));
      continue;
    }
    const Mode mode = twin->mode;
    merge_into(*twin, access);
    if (mode != Mode::read) twin->mode = Mode::update;
  }
  pass.accesses = std::move(kept);
  move_indices(pass, moved);
}

// Shaders name their accesses, so those names are the user's; the others only have to differ.
void name_hidden_accesses(Pass& pass) {
  std::set<std::string> taken;
  for (const Access& access : pass.accesses)
    if (is_shader_role(access.role) || access.role == Role::color) taken.insert(access.name);
  for (Access& access : pass.accesses) {
    if (is_shader_role(access.role) || access.role == Role::color) continue;
    const std::string base = access.name;
    if (!taken.insert(access.name).second) access.name = base + suffix_of(access.role);
    for (int i = 2; access.name != base && !taken.insert(access.name).second; ++i) access.name = base + suffix_of(access.role) + std::to_string(i);
  }
}

}  // namespace rg::dsl
