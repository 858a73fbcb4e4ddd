#include "compiler/fusion/fuse_passes.h"

#include <algorithm>
#include <map>

#include "compiler/fusion/write_kernel.h"
#include "compiler/shaders/agreement.h"

namespace rg::compiler {
namespace {

using dsl::DiagnosticKind;
using dsl::Mode;
using dsl::PassId;

// ---- sources of blocks

struct Forbidden {
  const char *prefix, *why;
  bool whole = false;
};
constexpr Forbidden kForbidden[] = {
    {"gl_", "where an element runs is the kernel's affair; `at` is its place"},
    {"barrier", "elements do not wait for each other", true},
    {"memoryBarrier", "elements do not wait for each other"},
    {"groupMemoryBarrier", "elements do not wait for each other"},
    {"shared", "elements share no memory", true},
    {"subgroup", "elements do not see their neighbours"},
    {"dFd", "elements do not see their neighbours"},
    {"fwidth", "elements do not see their neighbours"},
    {"rg_", "names that begin so belong to generated code"},
};

const Forbidden* forbidden(const GlslWord& word) {
  for (const Forbidden& row : kForbidden)
    if (row.whole ? word.text == row.prefix : word.text.starts_with(row.prefix)) return &row;
  return nullptr;
}

class Blocks {
 public:
  Blocks(const ReadFile& read, dsl::SourceFiles& files, dsl::Diagnostics& diagnostics)
      : sources_(read), places_(files, sources_), diagnostics_(diagnostics) {}

  // The source of a pass's block; what is wrong with it is reported once.
  const FlatSource& source(const dsl::Pass& pass) {
    const std::string& path = pass.shaders[0].path;
    const auto [at, fresh] = flat_.try_emplace(path);
    if (fresh) at->second = flatten(path, [this](const std::string& file, std::string& why) { return text_of(file, why); });
    return at->second;
  }

  // What the language of blocks does not have, and what the pass declares in vain.
  void check(const dsl::Pass& pass) {
    const FlatSource& flat = source(pass);
    if (!flat.missing.empty()) return void(diagnostics_.report(DiagnosticKind::ShaderNotReadable, pass.shaders[0].span, {flat.missing, flat.why}));
    const std::vector<GlslWord> words = glsl_words(flat.text);
    if (checked_.insert(pass.shaders[0].path).second && !check_words(pass, words)) return;
    check_functions(pass, global_names(words));
    check_used(pass, words);
  }

 private:
  std::optional<std::string> text_of(const std::string& path, std::string& why) {
    const std::string* text = sources_.find(path);
    if (text == nullptr) why = sources_.why_not(path);
    return text == nullptr ? std::nullopt : std::optional(*text);
  }

  bool check_words(const dsl::Pass& pass, const std::vector<GlslWord>& words) {
    for (const GlslWord& word : words) {
      const Forbidden* row = word.is_name() ? forbidden(word) : nullptr;
      if (row == nullptr) continue;
      const std::string name(word.text);
      diagnostics_.report(DiagnosticKind::NotForBlocks, places_.word_in_line(std::string(word.file), word.line, name), {name, row->why})
          .note(DiagnosticKind::ShaderOfPass, pass.shaders[0].span, {pass.name});
      return false;
    }
    return true;
  }

  void check_used(const dsl::Pass& pass, const std::vector<GlslWord>& words) {
    const std::set<std::string_view> used = [&] {
      std::set<std::string_view> all;
      for (const GlslWord& word : words) all.insert(word.text);
      return all;
    }();
    const auto need = [&](const std::string& name, dsl::Span span) {
      if (!used.contains(name))
        diagnostics_.report(DiagnosticKind::UnusedAccess, span, {name, pass.name})
            .note(DiagnosticKind::ShaderOfPass, pass.shaders[0].span, {pass.name});
    };
    for (const dsl::Access& access : pass.accesses)
      if (access.element || access.role == dsl::Role::sampled || access.role == dsl::Role::storage || access.role == dsl::Role::uniform)
        need(access.name, access.span);
    for (const dsl::ParamsUse& use : pass.params) need(use.name, use.span);
  }

  void check_functions(const dsl::Pass& pass, const std::set<std::string>& names) {
    std::vector<const char*> wanted = {"element"};
    if (pass.block->scan != dsl::kAll) wanted.push_back("start");
    if (pass.block->associative) wanted.insert(wanted.end(), {"own", "join"});
    for (const char* name : wanted)
      if (!names.contains(name)) diagnostics_.report(DiagnosticKind::BlockFunction, pass.shaders[0].span, {pass.shaders[0].path, name});
  }

  ShaderSources sources_;
  ShaderPlaces places_;
  dsl::Diagnostics& diagnostics_;
  std::map<std::string, FlatSource> flat_;
  std::set<std::string> checked_;
};

// ---- one graph

using Group = std::vector<PassId>;

class Fuser {
 public:
  Fuser(dsl::Program& program, dsl::GraphId id, const FusionOptions& options, Blocks& blocks, FusionResult& result, dsl::Diagnostics& diagnostics)
      : program_(program), graph_(program.graphs[id]), id_(id), options_(options), blocks_(blocks), result_(result), diagnostics_(diagnostics) {}

  dsl::Graph run() {
    for (const dsl::Pass& pass : graph_.passes)
      if (pass.block) blocks_.check(pass);
    if (diagnostics_.has_errors()) return graph_;
    for (size_t f = 0; f < graph_.fusions.size() && options_.fuse; ++f) split(dsl::FusionId{f});
    if (diagnostics_.has_errors()) return graph_;
    rewrite();
    return std::move(out_);
  }

 private:
  // Runs of passes that fuse, greedily in order.
  void split(dsl::FusionId id) {
    Group group;
    std::vector<Group> groups;
    for (size_t p = 0; p < graph_.passes.size(); ++p) {
      if (graph_.passes.rows[p].fusion != id) continue;
      const PassId pass{p};
      if (const auto obstacle = find_obstacle(program_, graph_, group, pass)) {
        refuse(graph_.fusions[id], pass, *obstacle);
        groups.push_back(std::move(group));
        group.clear();
        if (!graph_.passes[pass].block) continue;
      }
      group.push_back(pass);
    }
    groups.push_back(std::move(group));
    groups.erase(std::remove_if(groups.begin(), groups.end(), [](const Group& each) { return each.size() < 2; }), groups.end());
    for (size_t g = 0; g < groups.size(); ++g) plan(graph_.fusions[id], groups[g], groups.size() == 1 ? "" : "[" + std::to_string(g) + "]");
  }

  void refuse(const dsl::Fusion& fusion, PassId pass, const Obstacle& obstacle) {
    const std::string& name = graph_.passes[pass].name;
    if (fusion.may) result_.refusals.push_back({id_, fusion.name, name, obstacle.why, obstacle.places});
    const DiagnosticKind kind = fusion.may ? DiagnosticKind::NotFused : DiagnosticKind::CannotFuse;
    auto& diagnostic = diagnostics_.report(kind, graph_.passes[pass].span, {fusion.name, name, obstacle.why});
    for (const auto& [span, text] : obstacle.places) diagnostic.note(DiagnosticKind::FusedWith, span, {text});
  }

  struct Planned {
    const dsl::Fusion* fusion = nullptr;
    Group group;
    std::string name;
    std::set<dsl::ResourceId> dropped;
  };

  void plan(const dsl::Fusion& fusion, const Group& group, const std::string& suffix) {
    Planned planned{&fusion, group, fusion.name + suffix, {}};
    for (size_t r = 0; r < graph_.resources.size(); ++r)
      if (stays_inside(dsl::ResourceId{r}, group)) planned.dropped.insert(dsl::ResourceId{r});
    if (!knows_domain(planned)) {
      refuse(fusion, group.back(), {"no image is left that says where its elements end", {}});
      return;
    }
    for (const PassId member : group) planned_of_[member] = planned_.size();
    planned_.push_back(std::move(planned));
  }

  bool in(const Group& group, size_t pass) const { return std::find(group.begin(), group.end(), PassId{pass}) != group.end(); }

  // Written by a member before any reads it, and of no use outside.
  bool stays_inside(dsl::ResourceId id, const Group& group) const {
    const dsl::Resource& resource = graph_.resources[id];
    if (resource.lifetime != dsl::Lifetime::transient || resource.is_output) return false;
    bool written = false;
    for (size_t p = 0; p < graph_.passes.size(); ++p)
      for (const dsl::Access& access : graph_.passes.rows[p].accesses) {
        if (access.resource != id) continue;
        if (!in(group, p) || !access.element) return false;
        written |= access.mode == Mode::write;
        if (!written) return false;
      }
    return written;
  }

  bool knows_domain(const Planned& planned) const {
    const dsl::Pass& first = graph_.passes[planned.group.front()];
    const auto constant = [&](dsl::ExprId id) { return program_.exprs[id].op == dsl::ExprOp::constant; };
    if (std::all_of(first.dispatch.size, first.dispatch.size + 3, constant)) return true;
    for (const PassId member : planned.group)
      for (const dsl::Access& access : graph_.passes[member].accesses)
        if (access.element && graph_.resources[access.resource].kind == dsl::ResourceKind::image && !planned.dropped.contains(access.resource))
          return true;
    return false;
  }

  // ---- the graph anew

  void rewrite() {
    out_ = graph_;
    out_.passes.rows.clear();
    out_.fusions.rows.clear();
    std::vector<std::vector<PassId>> became(graph_.passes.size());
    for (size_t p = 0; p < graph_.passes.size(); ++p) {
      const auto found = planned_of_.find(PassId{p});
      const Planned* planned = found == planned_of_.end() ? nullptr : &planned_[found->second];
      if (planned == nullptr || planned->fusion->when) became[p].push_back(add(alone(PassId{p}, planned)));
      if (planned == nullptr || planned->group.back() != PassId{p}) continue;
      const PassId kernel = add(fused(*planned));
      for (const PassId member : planned->group) became[member.value].push_back(kernel);
    }
    renumber(became);
  }

  PassId add(dsl::Pass pass) { return out_.passes.add(std::move(pass)); }

  dsl::Pass alone(PassId id, const Planned* planned) {
    const dsl::Pass& pass = graph_.passes[id];
    if (!pass.block) {
      dsl::Pass plain = pass;
      plain.fusion = {};
      return plain;
    }
    dsl::Pass kernel = write_kernel(program_, graph_, {pass.name, {{id, blocks_.source(pass)}}, {}});
    kernel.after = pass.after;
    if (planned != nullptr) {
      dsl::Guard::Term term = *planned->fusion->when;
      term.negated = !term.negated;
      kernel.guard.terms.push_back(term);
    }
    return kernel;
  }

  dsl::Pass fused(const Planned& planned) {
    KernelOrder order{planned.name, {}, planned.dropped, planned.fusion->unrounded, options_.halves};
    for (const PassId member : planned.group) order.members.push_back({member, blocks_.source(graph_.passes[member])});
    dsl::Pass kernel = write_kernel(program_, graph_, order);
    kernel.span = planned.fusion->span;
    if (planned.fusion->when) kernel.guard.terms.push_back(*planned.fusion->when);
    record(planned, kernel);
    return kernel;
  }

  void record(const Planned& planned, const dsl::Pass& kernel) {
    FusedKernel row{id_, planned.fusion->name, planned.name, {}, {}};
    std::map<dsl::ResourceId, uint32_t> moves;
    const auto count = [&](const dsl::Pass& pass, int sign) {
      for (const dsl::Access& access : pass.accesses)
        if (access.element) moves[access.resource] += static_cast<uint32_t>(sign * (access.mode == Mode::update ? 2 : 1));
    };
    for (const PassId member : planned.group) {
      row.members.push_back(graph_.passes[member].name);
      count(graph_.passes[member], 1);
    }
    count(kernel, -1);
    for (const auto& [resource, accesses] : moves)
      if (accesses > 0) row.saved.push_back({resource, accesses, planned.dropped.contains(resource)});
    result_.kernels.push_back(std::move(row));
  }

  void renumber(const std::vector<std::vector<PassId>>& became) {
    for (size_t p = 0; p < out_.passes.size(); ++p) {
      std::vector<PassId> after;
      for (const PassId other : out_.passes.rows[p].after)
        for (const PassId each : became[other.value])
          if (each.value < p && std::find(after.begin(), after.end(), each) == after.end()) after.push_back(each);
      out_.passes.rows[p].after = std::move(after);
    }
    for (dsl::Params& params : out_.params)
      if (params.pass.valid()) params.pass = became[params.pass.value].back();
  }

  dsl::Program& program_;
  const dsl::Graph graph_;
  dsl::GraphId id_;
  const FusionOptions& options_;
  Blocks& blocks_;
  FusionResult& result_;
  dsl::Diagnostics& diagnostics_;
  std::vector<Planned> planned_;
  std::map<PassId, size_t> planned_of_;
  dsl::Graph out_;
};

}  // namespace

FusionResult fuse_passes(dsl::Program program, const ReadFile& read, dsl::SourceFiles& files, const FusionOptions& options,
                         dsl::Diagnostics& diagnostics) {
  FusionResult result;
  Blocks blocks(read, files, diagnostics);
  for (size_t g = 0; g < program.graphs.size(); ++g) {
    dsl::Graph graph = Fuser(program, dsl::GraphId{g}, options, blocks, result, diagnostics).run();
    program.graphs.rows[g] = std::move(graph);
  }
  result.program = std::move(program);
  return result;
}

}  // namespace rg::compiler
