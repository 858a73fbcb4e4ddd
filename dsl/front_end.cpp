#include "dsl/front_end.h"

#include <algorithm>
#include <deque>
#include <unordered_map>

#include "dsl/check.h"
#include "dsl/lexer.h"
#include "dsl/parser.h"
#include "dsl/paths.h"

namespace rg::dsl {
namespace {

constexpr size_t kMaxFileBytes = size_t{64} << 20;  // spans are 32 bits, and no frame is written by hand at this size

struct Loader {
  const ReadSource& read;
  Diagnostics& diagnostics;
  std::string root_folder;
  std::deque<SourceFile> files;  // trees hold views of the texts: they must not move
  std::vector<Module> modules;   // dependency order
  struct Visit {
    bool running = true;
    uint32_t module = UINT32_MAX;
    Span imported_at;
  };
  std::unordered_map<std::string, Visit> visits;  // by path inside the root folder
};

std::optional<std::string> read_text(Loader& loader, const std::string& path, Span span) {
  std::string why;
  auto text = loader.read(loader.root_folder + path, why);
  if (text && text->size() > kMaxFileBytes) text.reset(), why = "it is larger than 64 MiB";
  if (text && text->find('\0') != std::string::npos) text.reset(), why = "it is not text";
  if (!text) loader.diagnostics.report(DiagnosticKind::FileNotReadable, span, {span.file.valid() ? path : loader.root_folder + path, why});
  return text;
}

std::string stem(const std::string& path) {
  const std::string file = path.substr(folder_of(path).size());
  std::string name = file.substr(0, file.find('.'));
  for (char& c : name)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
  return name.empty() || (name[0] >= '0' && name[0] <= '9') ? "module_" + name : name;
}

std::optional<uint32_t> load(Loader& loader, const std::string& path, Span span, uint32_t depth);

// Of a path that leads out of the folder, or nowhere.
const char* why_no_file(std::string_view path) {
  if (path.empty()) return "the path is empty";
  const bool stays = path.front() != '/' && path.find("..") == std::string_view::npos;
  return stays && path.find_first_not_of("./") == std::string_view::npos ? "it is a folder" : nullptr;
}

std::optional<uint32_t> load_import(Loader& loader, const ast::Import& node, uint32_t depth) {
  const auto path = join_inside("", node.path);
  if (const char* why = path ? nullptr : why_no_file(node.path)) {
    loader.diagnostics.report(DiagnosticKind::FileNotReadable, node.span, {std::string(node.path), why});
    return std::nullopt;
  }
  if (!path) {
    loader.diagnostics.report(DiagnosticKind::ImportEscapes, node.span, {std::string(node.path)});
    return std::nullopt;
  }
  const auto seen = loader.visits.find(*path);
  if (seen == loader.visits.end()) return load(loader, *path, node.span, depth);
  if (!seen->second.running) return seen->second.module == UINT32_MAX ? std::nullopt : std::optional<uint32_t>(seen->second.module);
  Diagnostic diagnostic(DiagnosticKind::ImportCycle, node.span, {*path});
  if (seen->second.imported_at.file.valid()) diagnostic.note(DiagnosticKind::ImportedHere, seen->second.imported_at, {*path});
  loader.diagnostics.report(std::move(diagnostic));
  return std::nullopt;
}

void load_imports(Loader& loader, Module& module, uint32_t depth) {
  constexpr uint32_t kMaxDepth = 200;
  for (const ast::Import& node : module.tree.imports) {
    if (depth >= kMaxDepth) {
      loader.diagnostics.report(DiagnosticKind::ImportsTooDeep, node.span, {std::to_string(kMaxDepth)});
      module.tree.lost_names = true;
      return;
    }
    const auto imported = load_import(loader, node, depth + 1);
    if (!imported)
      module.tree.lost_names = true;
    else if (std::find(module.imports.begin(), module.imports.end(), *imported) != module.imports.end())
      loader.diagnostics.report(DiagnosticKind::RepeatedImport, node.span, {std::string(node.path)});
    else
      module.imports.push_back(*imported);
  }
}

void check_module_name(Loader& loader, const Module& module) {
  for (const Module& other : loader.modules) {
    if (other.name != module.name) continue;
    const Span span = module.tree.module.empty() ? Span{module.tree.file, 0, 0} : module.tree.module.span;
    Diagnostic diagnostic(DiagnosticKind::ModuleNameTaken, span, {module.name});
    diagnostic.note(DiagnosticKind::DeclaredHere, other.tree.module.span, {other.name});
    loader.diagnostics.report(std::move(diagnostic));
    return;
  }
}

// Why a code that stands behind `allow` is none of a warning; empty: it is.
std::string why_not_allowed(std::optional<DiagnosticKind> kind) {
  if (!kind) return "no diagnostic has this code";
  const Severity severity = row(*kind).severity;
  return severity == Severity::warning ? ""
         : severity == Severity::error ? "it is an error, and errors are mended"
                                       : "it is a note that goes with others";
}

void take_allowances(const ast::File& tree, std::vector<Allowance>& allowances, Diagnostics& diagnostics) {
  for (const ast::Allow& allow : tree.allows) {
    const auto kind = kind_of_code(allow.code.text);
    if (const std::string why = why_not_allowed(kind); why.empty()) {
      allowances.push_back({*kind, allow.scope, allow.span});
    } else {
      Diagnostic diagnostic(DiagnosticKind::AllowsNothing, allow.span, {std::string(allow.code.text.substr(0, 40)), why});
      for (const DiagnosticKind each : all_diagnostic_kinds())
        if (row(each).name == allow.code.text) diagnostic.fix(allow.code.span, std::string(row(each).code));
      diagnostics.report(std::move(diagnostic));
    }
  }
}

std::optional<uint32_t> load(Loader& loader, const std::string& path, Span span, uint32_t depth) {
  loader.visits[path] = {true, UINT32_MAX, span};
  auto text = read_text(loader, path, span);
  if (!text) {
    loader.visits[path].running = false;
    return std::nullopt;
  }
  const FileId file{loader.files.size()};
  const SourceFile& source = loader.files.emplace_back(loader.root_folder + path, std::move(*text));
  Module module;
  module.tree = parse(file, source.text, lex(file, source.text, loader.diagnostics), loader.diagnostics);
  module.name = module.tree.module.empty() ? stem(path) : std::string(module.tree.module.text);
  module.folder = folder_of(path);
  load_imports(loader, module, depth);
  check_module_name(loader, module);
  loader.modules.push_back(std::move(module));
  const auto index = static_cast<uint32_t>(loader.modules.size() - 1);
  loader.visits[path] = {false, index, span};
  return index;
}

}  // namespace

FrontEndResult load_program(const std::string& root_path, const ReadSource& read, Diagnostics& diagnostics) {
  FrontEndResult result;
  Loader loader{read, diagnostics, folder_of(root_path), {}, {}, {}};
  const bool loaded = load(loader, root_path.substr(loader.root_folder.size()), {}, 0).has_value();
  if (loaded) result.program = check(loader.modules, diagnostics);
  std::vector<Allowance> allowances;
  for (const Module& module : loader.modules) take_allowances(module.tree, allowances, diagnostics);
  diagnostics.allow(std::move(allowances));
  for (SourceFile& file : loader.files) result.files.add(std::move(file));
  diagnostics.drop_repeats();  // a mistake inside a loop is made once, however often the loop runs
  diagnostics.sort();
  return result;
}

}  // namespace rg::dsl
