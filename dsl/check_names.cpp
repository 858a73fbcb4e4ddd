// Which names each module sees: its own, and those of the modules it imports, directly or through others.
#include <functional>

#include "dsl/check_state.h"

namespace rg::dsl {
namespace {

struct Named {
  SymbolKind kind;
  ast::Name name;
};

template <class Node>
Named named(SymbolKind kind, const Node& node) {
  return {kind, node.name};
}

Named name_of(const ast::Declaration& declaration) {
  constexpr SymbolKind kKinds[] = {SymbolKind::constant, SymbolKind::extent, SymbolKind::structure, SymbolKind::interface,
                                   SymbolKind::sampler,  SymbolKind::state,  SymbolKind::feature,   SymbolKind::condition,
                                   SymbolKind::set,      SymbolKind::graph,  SymbolKind::spectrum};
  Named result = std::visit([&](const auto& node) { return named(kKinds[declaration.index()], node); }, declaration);
  const auto* graph = std::get_if<ast::GraphDeclaration>(&declaration);
  if (graph && graph->is_technique) result.kind = SymbolKind::technique;
  return result;
}

// Structs that stand in a `per_draw`, wherever in the items.
void collect_in_place(const std::vector<ast::Item>& items, std::vector<const ast::StructDeclaration*>& found);

void find_in_place(const ast::PassDeclaration& pass, std::vector<const ast::StructDeclaration*>& found) {
  for (const ast::Statement& statement : pass.statements) {
    const auto* draw = std::get_if<ast::DrawStatement>(&statement);
    if (draw && draw->per_draw && draw->per_draw->declaration) found.push_back(&*draw->per_draw->declaration);
  }
}
void find_in_place(const ast::For& node, std::vector<const ast::StructDeclaration*>& found) { collect_in_place(node.body, found); }
void find_in_place(const ast::IfHost& node, std::vector<const ast::StructDeclaration*>& found) { collect_in_place(node.body, found); }
void find_in_place(const ast::When& node, std::vector<const ast::StructDeclaration*>& found) {
  collect_in_place(node.body, found);
  collect_in_place(node.otherwise, found);
}
template <class Node>
void find_in_place(const Node&, std::vector<const ast::StructDeclaration*>&) {}

void collect_in_place(const std::vector<ast::Item>& items, std::vector<const ast::StructDeclaration*>& found) {
  for (const ast::Item& item : items) std::visit([&](const auto& node) { find_in_place(node, found); }, item.node);
}

void add_in_place(Checker& checker, uint32_t module, const ast::GraphDeclaration& graph) {
  std::vector<const ast::StructDeclaration*> found;
  collect_in_place(graph.body, found);
  for (const ast::StructDeclaration* record : found) {
    if (record->name.empty()) continue;
    const auto [at, fresh] = checker.own_names[module].emplace(record->name.text, static_cast<uint32_t>(checker.symbols.size()));
    if (!fresh) {
      report_duplicate(checker, record->name, checker.symbols[at->second].name.span);
      continue;
    }
    Symbol symbol;
    symbol.kind = SymbolKind::structure;
    symbol.module = module;
    symbol.record = record;
    symbol.name = record->name;
    checker.symbols.push_back(std::move(symbol));
  }
}

void collect_own_names(Checker& checker, uint32_t module) {
  auto& names = checker.own_names[module];
  const ast::File& tree = checker.modules[module].tree;
  for (size_t i = 0; i < tree.declarations.size(); ++i) {
    const ast::Declaration& declaration = tree.declarations[i];
    const Named found = name_of(declaration);
    if (found.name.empty()) continue;
    const auto [at, fresh] = names.emplace(found.name.text, static_cast<uint32_t>(checker.symbols.size()));
    if (!fresh) {
      report_duplicate(checker, found.name, checker.symbols[at->second].name.span);
      continue;
    }
    Symbol symbol;
    symbol.kind = found.kind;
    symbol.module = module;
    symbol.declaration = &declaration;
    symbol.name = found.name;
    symbol.is_private = i < tree.private_words.size() && !tree.private_words[i].empty();
    checker.symbols.push_back(std::move(symbol));
  }
  for (const ast::Declaration& declaration : tree.declarations)
    if (const auto* graph = std::get_if<ast::GraphDeclaration>(&declaration)) add_in_place(checker, module, *graph);
}

std::vector<uint32_t> visible_modules(const Checker& checker, uint32_t module) {
  std::vector<uint32_t> order;
  std::vector<bool> seen(checker.modules.size());
  seen[module] = true;
  std::vector<uint32_t> open = checker.modules[module].imports;
  for (size_t next = 0; next < open.size(); ++next) {
    const uint32_t at = open[next];
    if (seen[at]) continue;
    seen[at] = true;
    order.push_back(at);
    open.insert(open.end(), checker.modules[at].imports.begin(), checker.modules[at].imports.end());
  }
  return order;
}

void collect_scope(Checker& checker, uint32_t module) {
  auto& scope = checker.scopes[module];
  for (const uint32_t other : visible_modules(checker, module)) {
    checker.module_names[module].emplace(checker.modules[other].name, other);
    for (uint32_t symbol = 0; symbol < checker.symbols.size(); ++symbol) {
      if (checker.symbols[symbol].module != other || checker.symbols[symbol].is_private) continue;
      const auto [at, fresh] = scope.emplace(checker.symbols[symbol].name.text, Visible{symbol, UINT32_MAX});
      if (!fresh && at->second.other == UINT32_MAX) at->second.other = symbol;
    }
  }
  for (const auto& [name, symbol] : checker.own_names[module]) scope[name] = {symbol, UINT32_MAX};
  checker.module_names[module].emplace(checker.modules[module].name, module);
}

std::vector<std::string_view> names_of_kind(const Checker& checker, uint32_t module, SymbolKind kind) {
  std::vector<std::string_view> names;
  for (const Symbol& symbol : checker.symbols) {
    const bool visible = checker.scopes[module].count(symbol.name.text) != 0;
    if (visible && symbol.kind == kind) names.push_back(symbol.name.text);
  }
  return names;
}

void report_private(Checker& checker, const Symbol& hidden, Span span) {
  const std::string name(hidden.name.text);
  checker.report(DiagnosticKind::PrivateName, span, {name, checker.modules[hidden.module].name})
      .note(DiagnosticKind::DeclaredHere, hidden.name.span, {name});
}

void report_unknown(Checker& checker, uint32_t module, std::string_view name, Span span, SymbolKind kind) {
  if (checker.lost_names) return;  // perhaps declared in what did not parse
  if (!checker.unknown.emplace(std::to_string(module) + " " + std::string(name)).second) return;
  if (report_if_private(checker, module, name, span)) return;
  Diagnostic diagnostic(DiagnosticKind::UnknownName, span, {describe(kind), std::string(name)});
  const Guess guess = closest(name, names_of_kind(checker, module, kind));
  suggest(diagnostic, {span.file, span.end - static_cast<uint32_t>(name.size()), span.end}, guess);  // a module before it stays
  checker.diagnostics.report(std::move(diagnostic));
}

bool fits_kind(Checker& checker, uint32_t symbol, Span span, SymbolKind kind) {
  const Symbol& found = checker.symbols[symbol];
  checker.used[symbol] = true;
  if (found.kind == kind) return true;
  checker
      .report(DiagnosticKind::WrongKindOfName, span, {std::string(found.name.text), with_article(describe(found.kind)), with_article(describe(kind))})
      .note(DiagnosticKind::DeclaredHere, found.name.span, {std::string(found.name.text)});
  return false;
}

std::optional<uint32_t> find_plain(Checker& checker, uint32_t module, std::string_view name, Span span, SymbolKind kind) {
  const auto at = checker.scopes[module].find(name);
  if (at == checker.scopes[module].end()) {
    report_unknown(checker, module, name, span, kind);
    return std::nullopt;
  }
  const Visible visible = at->second;
  if (visible.other != UINT32_MAX) {
    const Symbol &first = checker.symbols[visible.symbol], &second = checker.symbols[visible.other];
    const std::string &one = checker.modules[first.module].name, &two = checker.modules[second.module].name;
    checker.report(DiagnosticKind::AmbiguousName, span, {std::string(name), one, two})
        .note(DiagnosticKind::DeclaredHere, first.name.span, {one + "." + std::string(name)})
        .note(DiagnosticKind::DeclaredHere, second.name.span, {two + "." + std::string(name)});
    return std::nullopt;
  }
  if (!fits_kind(checker, visible.symbol, span, kind)) return std::nullopt;
  return visible.symbol;
}

std::optional<uint32_t> find_qualified(Checker& checker, uint32_t module, const ast::Expr& expr, SymbolKind kind) {
  const ast::Expr& owner = expr.operands[0];
  const auto at = checker.module_names[module].find(owner.text);
  if (owner.kind != ast::ExprKind::name || at == checker.module_names[module].end()) {
    std::vector<std::string_view> names;
    for (const Module& each : checker.modules)
      if (checker.module_names[module].count(each.name)) names.push_back(each.name);
    Diagnostic diagnostic(DiagnosticKind::UnknownModule, owner.span, {spelled(owner)});
    const Guess guess = closest(owner.text, names);
    suggest(diagnostic, owner.span, guess);
    checker.diagnostics.report(std::move(diagnostic));
    return std::nullopt;
  }
  const auto& names = checker.own_names[at->second];
  const auto found = names.find(expr.text);
  if (found == names.end()) {
    report_unknown(checker, at->second, expr.text, expr.span, kind);
    return std::nullopt;
  }
  if (checker.symbols[found->second].is_private && at->second != module) {
    report_private(checker, checker.symbols[found->second], expr.span);
    return std::nullopt;
  }
  if (!fits_kind(checker, found->second, expr.span, kind)) return std::nullopt;
  return found->second;
}

}  // namespace

bool report_if_private(Checker& checker, uint32_t module, std::string_view name, Span span) {
  for (const uint32_t other : visible_modules(checker, module)) {
    const auto at = checker.own_names[other].find(name);
    if (at == checker.own_names[other].end() || !checker.symbols[at->second].is_private) continue;
    report_private(checker, checker.symbols[at->second], span);
    return true;
  }
  return false;
}

const char* describe(SymbolKind kind) {
  constexpr const char* kNames[] = {"constant", "extent",    "struct", "interface", "sampler",   "state",
                                    "feature",  "condition", "set",    "graph",     "technique", "spectrum"};
  return kNames[static_cast<size_t>(kind)];
}

std::string counted(size_t count, const char* noun) { return std::to_string(count) + " " + noun + (count == 1 ? "" : "s"); }

std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(noun);
}

std::string spelled(const ast::Expr& expr) {
  switch (expr.kind) {
    case ast::ExprKind::name:
      return std::string(expr.text);
    case ast::ExprKind::member:
      return spelled(expr.operands[0]) + "." + std::string(expr.text);
    case ast::ExprKind::integer:
    case ast::ExprKind::real:
    case ast::ExprKind::dimensions:
      return std::string(expr.text);
    case ast::ExprKind::index:
      return spelled(expr.operands[0]) + "[" + spelled(expr.operands[1]) + "]";
    case ast::ExprKind::call: {
      std::string arguments;
      for (size_t i = 1; i < expr.operands.size(); ++i) arguments += (i > 1 ? ", " : "") + spelled(expr.operands[i]);
      return spelled(expr.operands[0]) + "(" + arguments + ")";
    }
    default:
      return "...";
  }
}

void report_duplicate(Checker& checker, const ast::Name& name, Span first) {
  checker.report(DiagnosticKind::DuplicateName, name.span, {std::string(name.text)})
      .note(DiagnosticKind::DeclaredHere, first, {std::string(name.text)});
}

bool claim_public_name(Checker& checker, const ast::Name& name) {
  const auto [at, fresh] = checker.public_names.emplace(name.text, name.span);
  if (!fresh) report_duplicate(checker, name, at->second);
  return fresh;
}

void collect_names(Checker& checker) {
  const size_t count = checker.modules.size();
  checker.own_names.resize(count);
  checker.scopes.resize(count);
  checker.module_names.resize(count);
  for (uint32_t module = 0; module < count; ++module) collect_own_names(checker, module);
  checker.used.resize(checker.symbols.size());
  for (uint32_t module = 0; module < count; ++module) collect_scope(checker, module);
}

std::optional<uint32_t> find_symbol(Checker& checker, uint32_t module, const ast::Expr& expr, SymbolKind kind) {
  if (expr.kind == ast::ExprKind::error) return std::nullopt;
  if (expr.kind == ast::ExprKind::name) return find_plain(checker, module, expr.text, expr.span, kind);
  if (expr.kind == ast::ExprKind::member) return find_qualified(checker, module, expr, kind);
  checker.report(DiagnosticKind::NotAName, expr.span, {with_article(describe(kind))});
  return std::nullopt;
}

std::optional<uint32_t> find_symbol(Checker& checker, uint32_t module, const ast::Name& name, SymbolKind kind) {
  if (name.empty()) return std::nullopt;
  return find_plain(checker, module, name.text, name.span, kind);
}

std::optional<uint32_t> peek_symbol(const Checker& checker, uint32_t module, const ast::Expr& expr) {
  if (expr.kind == ast::ExprKind::name) {
    const auto at = checker.scopes[module].find(expr.text);
    if (at == checker.scopes[module].end()) return std::nullopt;
    return at->second.symbol;
  }
  if (expr.kind != ast::ExprKind::member || expr.operands[0].kind != ast::ExprKind::name) return std::nullopt;
  const auto owner = checker.module_names[module].find(expr.operands[0].text);
  if (owner == checker.module_names[module].end()) return std::nullopt;
  const auto found = checker.own_names[owner->second].find(expr.text);
  if (found == checker.own_names[owner->second].end()) return std::nullopt;
  if (checker.symbols[found->second].is_private && owner->second != module) return std::nullopt;
  return found->second;
}

}  // namespace rg::dsl
