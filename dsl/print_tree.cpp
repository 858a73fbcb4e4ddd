// Trees as nested lists: `(pass luminance (compute) (read (name hdr) (as sampled)))`.
#include <fmt/format.h>

#include "dsl/print.h"

namespace rg::dsl {
namespace {

using namespace ast;

struct Printer {
  std::string out;
  size_t depth = 0;

  void line(const std::string& text) { out += std::string(2 * depth, ' ') + text + "\n"; }
};

std::string text(const Name& name) { return name.empty() ? "?" : std::string(name.text); }

std::string text(const ast::Expr& expr) {
  constexpr const char* kOperators[] = {"error", "", "", "", "", "", "index", "call", "list", "-", "+", "-", "*", "/", "%"};
  if (expr.kind == ExprKind::error) return "?";
  const bool leaf = expr.kind == ExprKind::integer || expr.kind == ExprKind::real || expr.kind == ExprKind::dimensions || expr.kind == ExprKind::name;
  if (leaf) return std::string(expr.text);
  if (expr.kind == ExprKind::member) return text(expr.operands[0]) + "." + std::string(expr.text);
  std::string out = std::string("(") + kOperators[static_cast<size_t>(expr.kind)];
  for (const ast::Expr& operand : expr.operands) out += " " + text(operand);
  return out + ")";
}

std::string text(const ast::Boxed<ast::Expr>& expr) { return expr ? " " + text(*expr) : ""; }

std::string text(const std::vector<ast::Expr>& indices) {
  std::string out;
  for (const ast::Expr& index : indices) out += "[" + text(index) + "]";
  return out;
}

std::string text(const TypeName& type) {
  std::string out = text(type.name);
  if (type.unsized) return out + "[]";
  return type.count ? out + "[" + text(*type.count) + "]" : out;
}

std::string text(const Usage& usage) {
  std::string out = " as " + text(usage.role);
  if (usage.sampler) out += "(" + text(*usage.sampler) + ")";
  for (const Name& stage : usage.stages) out += " in " + text(stage);
  return out;
}

std::string text(const Setting& setting) {
  std::string out = " (" + text(setting.word);
  if (!setting.second.empty()) out += " " + text(setting.second);
  for (const Name& name : setting.names) out += " " + text(name);
  for (const ast::Expr& value : setting.values) out += " " + text(value);
  return out + ")";
}

std::string settings_text(const std::vector<Setting>& settings) {
  std::string out;
  for (const Setting& setting : settings) out += text(setting);
  return out;
}

std::string resource_text(const ResourceDeclaration& node) {
  std::string out = node.is_buffer ? "buffer " : "image ";
  out += text(node.name) + text(node.index) + " : ";
  out += node.is_buffer ? text(node.element) : text(node.format) + text(node.size);
  out += settings_text(node.settings);
  if (node.has_init) out += " (init" + text(node.clear) + ")";
  if (node.ready) out += std::string(node.wrote ? " (written" : " (ready") + text(*node.ready) + ")";
  if (node.after) out += " (after" + text(*node.after) + ")";
  return out + (node.has_error ? " !" : "");
}

std::string access_text(const AccessStatement& node) {
  constexpr const char* kVerbs[] = {"read", "write", "update", "atomic", "color", "depth", "stencil"};
  std::string out = kVerbs[static_cast<size_t>(node.verb)];
  if (!node.rename.empty()) out += " " + text(node.rename) + " =";
  out += " " + text(node.target);
  if (node.usage) out += text(*node.usage);
  for (const Name& stage : node.stages) out += " in " + text(stage);
  if (node.clear) out += " clear" + text(node.clear);
  if (node.blend) {
    out += " blend " + text(node.blend->op);
    for (const Name& factor : node.blend->factors) out += " " + text(factor);
  }
  for (const auto& [set, option] : {std::pair{node.covers, " covers"}, {node.disjoint, " disjoint"}, {node.readonly, " readonly"}})
    if (set) out += option;
  return out;
}

void visit(Printer& at, const AccessStatement& node) { at.line(access_text(node)); }

void visit(Printer& at, const ShaderStatement& node) {
  std::string out = node.fullscreen ? "fullscreen" : node.block ? "block" : "shader";
  for (const auto& path : node.paths) out += " \"" + std::string(path.text) + "\"";
  for (const ast::Expr& size : node.group) out += " " + text(size);
  if (!node.scan.empty()) out += " scan " + text(node.scan) + (node.carry ? " " + text(*node.carry) : "") + (node.associative ? " associative" : "");
  at.line(out);
}

void visit(Printer& at, const DispatchStatement& node) { at.line("dispatch " + text(node.how) + text(node.size)); }

void visit(Printer& at, const DrawStatement& node) {
  std::string out = node.host ? "draw host" : node.indirect ? "draw indirect" : "draw";
  if (node.indexed) out.insert(4, " indexed");
  out += text(node.vertices) + text(node.arguments);
  if (node.instances) out += " instances" + text(node.instances);
  if (node.first) out += " first" + text(node.first);
  if (node.offset) out += " offset" + text(node.offset);
  if (node.max_draws) out += " max" + text(node.max_draws);
  if (node.counts) out += " count" + text(node.counts);
  if (node.per_draw) out += " per_draw " + (node.per_draw->type ? text(*node.per_draw->type) : text(node.per_draw->name));
  for (const ast::VertexStatement& vertex : node.vertex) out += (vertex.per_instance ? " instance " : " vertex ") + text(vertex.type);
  at.line(out);
}

void visit(Printer& at, const TransferStatement& node) {
  at.line(text(node.verb) + text(node.src) + (node.src ? " ->" : "") + text(node.dst) + text(node.value) + (node.linear ? " linear" : ""));
}

void visit(Printer& at, const HostTransfer& node) {
  at.line("host");
  ++at.depth;
  for (const AccessStatement& access : node.accesses) visit(at, access);
  --at.depth;
}

void visit(Printer& at, const ParamsStatement& node) { at.line("params " + text(node.name) + (node.type ? ":" + text(node.type) : "")); }
void visit(Printer& at, const WordStatement& node) { at.line(text(node.word) + text(node.value)); }

void visit(Printer& at, const FeaturesStatement& node) {
  std::string out = "features";
  for (const Name& name : node.names) out += " " + text(name);
  at.line(out);
}
void visit(Printer& at, const SpectrumStatement& node) {
  at.line("spectrum " + text(node.spectrum) + " by" + text(node.masks) + (node.kernels ? " into" + text(*node.kernels) : ""));
}

void print_items(Printer& at, const std::vector<Item>& items);

void visit(Printer& at, const ResourceDeclaration& node) { at.line(resource_text(node)); }

void visit(Printer& at, const PassDeclaration& node) {
  std::string out = "pass " + text(node.name) + text(node.index) + " : " + text(node.kind);
  if (!node.queue.empty()) out += " queue " + text(node.queue) + (node.queue_may ? " may" : "");
  at.line(out + (node.has_error ? " !" : ""));
  ++at.depth;
  for (const Statement& statement : node.statements) std::visit([&](const auto& each) { visit(at, each); }, statement);
  --at.depth;
}

void visit(Printer& at, const BundleDeclaration& node) {
  at.line("bundle " + text(node.name) + (node.has_error ? " !" : ""));
  ++at.depth;
  for (const Statement& statement : node.statements) std::visit([&](const auto& each) { visit(at, each); }, statement);
  --at.depth;
}

void visit(Printer& at, const For& node) {
  at.line("for " + text(node.variable) + " in " + text(node.first) + ".." + text(node.last));
  print_items(at, node.body);
}

std::string term_text(const FeatureTerm& term) {
  return (term.negated ? "not " : "") + text(term.feature) + (term.value.empty() ? "" : " == " + text(term.value));
}

void visit(Printer& at, const When& node) {
  at.line("when " + term_text(node.term));
  print_items(at, node.body);
  if (node.otherwise.empty()) return;
  at.line("else");
  print_items(at, node.otherwise);
}

void visit(Printer& at, const IfHost& node) {
  at.line("if host " + text(node.condition) + (node.index ? "[" + text(*node.index) + "]" : ""));
  print_items(at, node.body);
}

void visit(Printer& at, const Use& node) {
  std::string out = "use " + (node.instance.empty() ? "" : text(node.instance) + text(node.index) + " = ") + text(node.technique);
  for (size_t i = 0; i < node.arguments.size(); ++i)
    out += (i < node.directions.size() && !node.directions[i].empty() ? " " + text(node.directions[i]) : "") + " " + text(node.arguments[i]);
  at.line(out);
}

void visit(Printer& at, const Fuse& node) {
  at.line("fuse " + text(node.name) + (node.may ? " may" : "") + (node.unrounded ? " unrounded" : "") +
          (node.term ? " when " + term_text(*node.term) : ""));
  print_items(at, node.body);
}

void visit(Printer& at, const ast::Assertion& node) { at.line(std::string(node.text)); }

void print_items(Printer& at, const std::vector<Item>& items) {
  ++at.depth;
  for (const Item& item : items) std::visit([&](const auto& node) { visit(at, node); }, item.node);
  --at.depth;
}

void visit(Printer& at, const Constant& node) { at.line("const " + text(node.name) + " = " + text(node.value)); }

void visit(Printer& at, const ExtentDeclaration& node) {
  std::string out = "extent " + text(node.name) + " (runtime";
  for (const ast::Expr& axis : node.initial) out += " " + text(axis);
  if (!node.minimum.empty()) out += ") (min";
  for (const ast::Expr& axis : node.minimum) out += " " + text(axis);
  out += ") (max";
  for (const ast::Expr& axis : node.maximum) out += " " + text(axis);
  at.line(out + ")");
}

void visit(Printer& at, const StructDeclaration& node) {
  at.line("struct " + text(node.name) + (node.scalar ? " scalar" : ""));
  ++at.depth;
  for (const FieldDeclaration& field : node.fields) at.line(text(field.name) + ": " + text(field.type));
  --at.depth;
}

void visit(Printer& at, const InterfaceDeclaration& node) {
  at.line("interface " + text(node.name));
  ++at.depth;
  for (const ResourceDeclaration& member : node.members) at.line(resource_text(member));
  --at.depth;
}

void visit(Printer& at, const SamplerDeclaration& node) { at.line("sampler " + text(node.name) + settings_text(node.settings)); }
void visit(Printer& at, const StateDeclaration& node) { at.line("state " + text(node.name) + settings_text(node.settings)); }

void visit(Printer& at, const FeatureDeclaration& node) {
  std::string out = "feature " + text(node.name) + ":" +
                    (!node.capability.empty() ? " device " + text(node.capability)
                     : node.is_bool           ? " bool"
                                              : "");
  for (const Name& value : node.values) out += " " + text(value);
  for (const FeatureRule& rule : node.rules)
    out += " (" + (rule.value.empty() ? "" : text(rule.value) + " ") + (rule.excludes ? "excludes " : "requires ") + term_text(rule.term) + ")";
  at.line(out);
}

void visit(Printer& at, const ConditionDeclaration& node) {
  at.line("condition " + text(node.name) + (node.count ? "[" + text(*node.count) + "]" : ""));
}
void visit(Printer& at, const EngineSetDeclaration& node) { at.line(fmt::format("set {} {}", text(node.name), node.set)); }

void visit(Printer& at, const SpectrumDeclaration& node) {
  at.line("spectrum " + text(node.name) + (node.modes ? " modes" + text(*node.modes) : "") +
          (node.profile.empty() ? "" : " profile " + std::string(node.profile)));
  ++at.depth;
  for (const auto& member : node.members) {
    std::string out = text(member.name) + (member.needs.empty() ? "" : " requires");
    for (const Name& need : member.needs) out += " " + text(need);
    at.line(out);
  }
  --at.depth;
}

std::string parameter_text(const Parameter& node) {
  constexpr const char* kKinds[] = {"params ", "surface ", "", "image ", "buffer ", "const "};
  constexpr const char* kDirections[] = {"", "out ", "inout "};
  std::string out = kDirections[static_cast<size_t>(node.direction)] + std::string(kKinds[static_cast<size_t>(node.kind)]);
  if (node.kind == Parameter::Kind::surface) return out + resource_text(node.surface);
  return out + text(node.name) + (node.type.kind == ExprKind::error ? "" : ": " + text(node.type));
}

void visit(Printer& at, const GraphDeclaration& node) {
  at.line((node.is_technique ? "technique " : "graph ") + text(node.name) + (node.has_error ? " !" : ""));
  ++at.depth;
  for (const Parameter& parameter : node.parameters) at.line("parameter " + parameter_text(parameter));
  --at.depth;
  print_items(at, node.body);
}

}  // namespace

std::string print_tree(const File& file) {
  Printer at;
  at.line("module " + text(file.module));
  for (const Import& import : file.imports) at.line("import \"" + std::string(import.path) + "\"");
  if (file.target)
    at.line(fmt::format("target {} {}", text(file.target->api), file.target->version) +
            (file.target->with.empty() ? "" : " with " + text(file.target->with)));
  for (const ProfileTarget& profile : file.profiles) at.line("target profile \"" + std::string(profile.path) + "\"");
  for (const Allow& allow : file.allows) at.line("allow " + text(allow.code) + fmt::format(" in {}..{}", allow.scope.begin, allow.scope.end));
  for (const Declaration& declaration : file.declarations) std::visit([&](const auto& node) { visit(at, node); }, declaration);
  return at.out;
}

}  // namespace rg::dsl
