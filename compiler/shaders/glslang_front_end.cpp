#include "compiler/shaders/glslang_front_end.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "compiler/shaders/expansion.h"
#include "compiler/shaders/variants.h"

namespace rg::compiler {
namespace {

constexpr std::string_view kPreludeName = "<interface>";

EShLanguage language(dsl::Stage stage) {
  switch (stage) {
    case dsl::stage_vertex:
      return EShLangVertex;
    case dsl::stage_tess_control:
      return EShLangTessControl;
    case dsl::stage_tess_eval:
      return EShLangTessEvaluation;
    case dsl::stage_geometry:
      return EShLangGeometry;
    case dsl::stage_fragment:
      return EShLangFragment;
    default:
      return EShLangCompute;
  }
}

// A shader's texts and how long each becomes.
class Lengths {
 public:
  Lengths(const std::string& prelude, const std::vector<SourceText>& closure) {
    add("", prelude);
    for (const SourceText& source : closure)
      if (source.text != nullptr) add(source.path, *source.text);
  }
  Expansions::Measure of(const std::string& path) {
    const auto found = words_.find(path);
    return found == words_.end() ? Expansions::Measure{} : expansions_.measure(found->second);
  }

 private:
  void add(const std::string& path, std::string_view text) { expansions_.add_macros(words_.emplace(path, glsl_words(text)).first->second); }
  std::map<std::string, std::vector<GlslWord>> words_;
  Expansions expansions_;
};

class Includer : public glslang::TShader::Includer {
 public:
  Includer(ShaderSources& sources, const std::string& path, std::set<std::string>& names, Lengths& lengths)
      : sources_(sources), path_(path), names_(names), lengths_(lengths) {}

  IncludeResult* includeLocal(const char* header, const char* includer, size_t depth) override {
    if (!stopped_.empty()) return fail(stopped_);  // glslang goes on, and files that include twice would take as long as without a limit
    if (depth > kMostDepth)
      return stop(loops_ ? "it includes itself, directly or through others" : "more than 32 files include one another in a row");
    if (++count_ > kMostIncludes) return stop("more than 1024 files are included");
    // glslang calls every line of the first level by the name of the first string.
    const std::string from = includer == kPreludeName ? path_ : includer;
    std::string why;
    for (const std::string& folder : {folder_of(from), std::string()}) {
      const auto path = resolve_path(folder, header);
      const std::string* found = path ? sources_.find(*path) : nullptr;
      const std::string problem = path ? sources_.why_not(*path) : "it is outside the folder of the root file";
      if (found == nullptr) {
        why += why.empty() ? problem : why == problem ? "" : "; from the root file: " + problem;
        continue;
      }
      words_ += lengths_.of(*path).words;
      if (words_ > kMostWords) return stop("the text becomes longer than " + std::to_string(kMostWords) + " words");
      enter(*path, depth);
      names_.insert(*path);
      return new IncludeResult(*path, found->data(), found->size(), nullptr);
    }
    return fail(why);
  }
  // glslang asks here too after includeLocal has failed.
  IncludeResult* includeSystem(const char*, const char*, size_t) override { return fail(std::exchange(why_, kNoSystem)); }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  static constexpr size_t kMostDepth = 32, kMostIncludes = 1024;
  static constexpr const char* kNoSystem = "write \"PATH\": there are no files of the system";

  // Without a name, a text is the message that glslang gives.
  IncludeResult* fail(const std::string& why) {
    why_ = why;
    const std::string& kept = *told_.insert(why).first;
    return new IncludeResult("", kept.data(), kept.size(), nullptr);
  }
  IncludeResult* stop(const std::string& why) { return fail(stopped_ = why); }
  // A file within itself may stop at a guard, so that only the depth counts.
  void enter(const std::string& path, size_t depth) {
    inside_.resize(std::min(inside_.size(), depth > 0 ? depth - 1 : 0));
    loops_ = path == path_ || std::find(inside_.begin(), inside_.end(), path) != inside_.end();
    inside_.push_back(path);
  }

  ShaderSources& sources_;
  const std::string& path_;
  std::set<std::string>& names_;
  Lengths& lengths_;
  std::vector<std::string> inside_;  // the files around the current one
  bool loops_ = false;
  size_t count_ = 0;
  uint64_t words_ = 0;
  std::string why_ = kNoSystem, stopped_;
  std::set<std::string> told_;  // texts that glslang was given
};

void start_glslang() {
  static const bool started = glslang::InitializeProcess();
  (void)started;
}

// "NAME:12: text" where NAME is one of `names`; longer names first, as one may end another.
ShaderMessage place(std::string_view line, const std::set<std::string>& names) {
  ShaderMessage message;
  message.text = line;
  size_t matched = 0;
  for (const std::string& name : names) {
    if (name.size() < matched || !line.starts_with(name) || line.size() <= name.size() || line[name.size()] != ':') continue;
    const size_t digits = name.size() + 1, colon = line.find(':', digits);
    if (colon == std::string_view::npos) continue;
    matched = name.size();
    message.file = name == kPreludeName ? "" : name;
    message.line = static_cast<uint32_t>(std::strtoul(std::string(line.substr(digits, colon - digits)).c_str(), nullptr, 10));
    message.text = line.substr(std::min(colon + 2, line.size()));
  }
  return message;
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.pop_back();
  return text;
}

// The first error only: what follows is mostly its consequence.
std::vector<ShaderMessage> parse_log(const std::string& log, const std::set<std::string>& names) {
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    constexpr std::string_view kError = "ERROR: ";
    line = trimmed(line);
    if (line.starts_with(kError)) return {place(std::string_view(line).substr(kError.size()), names)};
  }
  return {{"", 0, "the shader compiler failed without a message"}};
}

// The files that a text says its lines come from.
void add_line_names(const std::string& text, std::set<std::string>& names) {
  for (size_t at = text.find("#line "); at != std::string::npos; at = text.find("#line ", at + 1)) {
    const size_t end = text.find('\n', at), open = text.find('"', at), close = text.find('"', open + 1);
    if (close < end) names.insert(text.substr(open + 1, close - open - 1));
  }
}

void configure(glslang::TShader& shader, dsl::Stage stage) {
  shader.setEnvInput(glslang::EShSourceGlsl, language(stage), glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
}

}  // namespace

void warm_front_end() {
  ShaderSources nothing([](const std::string&, std::string&) { return std::nullopt; });
  (void)compile_glsl(dsl::stage_compute, "", "warm.comp", "#version 460\nvoid main() {}\n", nothing);
}

FrontEndOutput compile_glsl(dsl::Stage stage, const std::string& prelude, const std::string& path, const std::string& text, ShaderSources& sources) {
  Lengths becomes(prelude, include_closure(path, text, sources));
  if (const Expansions::Measure measure = becomes.of(path); measure.words > kMostWords) {
    const std::string place(measure.longest->file);
    return {{}, {{place.empty() ? path : place, measure.longest->line, "", std::string(measure.longest->text)}}};
  }
  start_glslang();
  std::set<std::string> names = {std::string(kPreludeName), path};
  add_line_names(text, names);
  const char* texts[] = {prelude.c_str(), text.c_str()};
  const int lengths[] = {static_cast<int>(prelude.size()), static_cast<int>(text.size())};
  const char* labels[] = {kPreludeName.data(), path.c_str()};
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

  glslang::TShader shader(language(stage));
  const int skipped = prelude.empty() ? 1 : 0;
  shader.setStringsWithLengthsAndNames(texts + skipped, lengths + skipped, labels + skipped, 2 - skipped);
  configure(shader, stage);
  Includer includer(sources, path, names, becomes);
  FrontEndOutput output;
  if (!shader.parse(GetDefaultResources(), 460, false, messages, includer)) {
    output.errors = parse_log(shader.getInfoLog(), names);
    return output;
  }
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) {
    output.errors = parse_log(program.getInfoLog(), names);
    return output;
  }
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  spv::SpvBuildLogger logger;
  glslang::GlslangToSpv(*program.getIntermediate(language(stage)), output.words, &logger, &options);
  return output;
}

}  // namespace rg::compiler
