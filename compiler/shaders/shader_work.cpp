#include "compiler/shaders/shader_work.h"

#include <algorithm>

namespace rg::compiler {
namespace {

const std::string kFullscreenPath = "rgc/fullscreen.vert";
const std::string kFullscreenText = kFullscreenVertexShader;

std::vector<dsl::Shader> shaders_in_stage_order(const dsl::Pass& pass) {
  std::vector<dsl::Shader> shaders = pass.shaders;
  if (is_fullscreen(pass) && !shaders.empty()) shaders.push_back({dsl::stage_vertex, kFullscreenPath, shaders.front().span});
  std::stable_sort(shaders.begin(), shaders.end(), [](const auto& a, const auto& b) { return a.stage < b.stage; });
  return shaders;
}

bool has_kernels(const dsl::Pass& pass) {
  return !pass.features.empty() && std::none_of(pass.features.begin(), pass.features.end(), [](const auto& each) { return each.feature.valid(); });
}

class Collector {
 public:
  Collector(const dsl::Program& program, const dsl::Graph& graph, const VariantSpace& space, ShaderSources& sources, dsl::Diagnostics& diagnostics)
      : program_(program), graph_(graph), space_(space), sources_(sources), diagnostics_(diagnostics) {}

  ShaderWork run() {
    for (size_t p = 0; p < graph_.passes.size(); ++p) {
      const dsl::Pass& pass = graph_.passes.rows[p];
      check_stages(pass, diagnostics_);
      work_.passes.push_back(uses_of(pass, p));
    }
    return std::move(work_);
  }

 private:
  std::vector<ShaderUse> uses_of(const dsl::Pass& pass, size_t index) {
    std::vector<ShaderUse> uses;
    for (const dsl::Shader& shader : shaders_in_stage_order(pass)) {
      ShaderUse use{shader, "", {}, {}};
      const std::string* text = find_text(use);
      if (text == nullptr) return {};
      add_jobs(pass, index, *text, use);
      uses.push_back(std::move(use));
    }
    return uses;
  }

  // Fills the path; null after a report.
  const std::string* find_text(ShaderUse& use) {
    use.path = use.shader.path;
    if (is_generated_fullscreen(use)) return &kFullscreenText;
    if (!use.shader.text.empty()) return &sources_.keep(use.shader.path, use.shader.text);
    const auto path = resolve_path("", use.shader.path);  // the checker made it relative to the root folder
    const std::string* text = path ? sources_.find(*path) : nullptr;
    const std::string problem = path ? sources_.why_not(*path) : "it lies outside the root file's folder";
    if (text == nullptr) diagnostics_.report(dsl::DiagnosticKind::ShaderNotReadable, use.shader.span, {use.shader.path, problem});
    if (path) use.path = *path;
    return text;
  }

  void add_jobs(const dsl::Pass& pass, size_t index, const std::string& text, ShaderUse& use) {
    const bool own = is_generated_fullscreen(use);
    std::vector<SourceText> closure = own ? std::vector<SourceText>{{use.path, &text}} : include_closure(use.path, text, sources_);
    const std::vector<bool> fixed = features_of_preprocessor(pass, closure);
    for (const VariantRow& row : space_.passes[index]) {
      use.keys.push_back(preprocessor_key(row.values, fixed));
      const auto same = static_cast<size_t>(std::find(use.keys.begin(), use.keys.end() - 1, use.keys.back()) - use.keys.begin());
      if (same < use.jobs.size()) {
        use.jobs.push_back(use.jobs[same]);
        continue;
      }
      const Prelude prelude = own ? Prelude{} : make_prelude(program_, graph_, pass, use.shader.stage, use.keys.back());
      use.jobs.push_back(add_job({use.shader.stage, use.path, rg::compiler::text(prelude), &text, closure, has_kernels(pass)}));
    }
  }

  size_t add_job(FrontEndJob job) {
    const auto same = [&](const FrontEndJob& other) { return other.stage == job.stage && other.path == job.path && other.prelude == job.prelude; };
    const auto found = std::find_if(work_.jobs.begin(), work_.jobs.end(), same);
    if (found != work_.jobs.end()) return static_cast<size_t>(found - work_.jobs.begin());
    work_.jobs.push_back(std::move(job));
    return work_.jobs.size() - 1;
  }

  const dsl::Program& program_;
  const dsl::Graph& graph_;
  const VariantSpace& space_;
  ShaderSources& sources_;
  dsl::Diagnostics& diagnostics_;
  ShaderWork work_;
};

}  // namespace

bool is_generated_fullscreen(const ShaderUse& use) { return use.shader.path == kFullscreenPath; }

ShaderWork collect_work(const dsl::Program& program, const dsl::Graph& graph, const VariantSpace& space, ShaderSources& sources,
                        dsl::Diagnostics& diagnostics) {
  return Collector(program, graph, space, sources, diagnostics).run();
}

}  // namespace rg::compiler
