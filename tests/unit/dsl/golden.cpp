#include "golden.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rg::dsl::golden {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> lines;
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string title(const Diagnostic& diagnostic) {
  constexpr const char* kNames[] = {"error", "warning", "note"};
  const DiagnosticRow& info = row(diagnostic.kind);
  return std::string(kNames[static_cast<size_t>(diagnostic.severity())]) + "[" + std::string(info.code) + "]: " + diagnostic.message();
}

Expectation expectation_of(const SourceFiles& files, const Diagnostic& diagnostic) {
  if (!diagnostic.span.file.valid()) return {"", 0, title(diagnostic)};
  const SourceFile& file = files[diagnostic.span.file];
  return {file.path, file.position(diagnostic.span.begin).line, title(diagnostic)};
}

bool stands_alone(const std::string& line) { return line.find_first_not_of(" \t") == line.find("//~"); }

// Where a comment would change the meaning, or there is one already.
bool takes_no_comment(const std::string& line) { return line.find("//") != std::string::npos || std::count(line.begin(), line.end(), '"') % 2 != 0; }

}  // namespace

std::string root() { return std::string(RGC_SOURCE_DIR) + "/tests/golden"; }

std::vector<std::string> inputs(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(root() + "/" + folder))
    if (entry.path().extension() == ".rg") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

bool updating() {
  const char* value = std::getenv("RGC_UPDATE");
  return value && std::string(value) == "1";
}

std::vector<Expectation> expectations(const std::string& file, const std::string& text) {
  std::vector<Expectation> all;
  uint32_t number = 0;
  for (const std::string& line : split(text)) {
    ++number;
    size_t at = line.find("//~");
    if (at == std::string::npos) continue;
    at += 3;
    uint32_t up = 0;
    for (; at < line.size() && line[at] == '^'; ++at) ++up;
    all.push_back({file, number - up, line.substr(std::min(line.size(), at + 1))});
  }
  return all;
}

std::string without_expectations(const std::string& text) {
  std::string out;
  for (const std::string& line : split(text)) {
    const size_t at = line.find("//~");
    if (at == std::string::npos) {
      out += line + "\n";
      continue;
    }
    if (stands_alone(line)) continue;
    std::string kept = line.substr(0, at);
    while (!kept.empty() && kept.back() == ' ') kept.pop_back();
    out += kept + "\n";
  }
  return out;
}

std::string with_expectations(const std::string& text, const std::vector<Expectation>& expected) {
  std::string out;
  uint32_t number = 0;
  for (const std::string& line : split(text)) {
    ++number;
    out += line;
    std::string carets = takes_no_comment(line) ? "^" : "";
    for (const Expectation& each : expected) {
      if (each.line != number) continue;
      out += (carets.empty() ? "  //~ " : "\n//~" + carets + " ") + each.text;
      carets += "^";
    }
    out += "\n";
  }
  return out;
}

Loaded load(const std::string& path, const std::map<std::string, std::string>& replaced) {
  Loaded loaded;
  const auto read = [&](const std::string& wanted, std::string& why) -> std::optional<std::string> {
    const auto at = replaced.find(wanted);
    if (at != replaced.end()) return at->second;
    if (std::filesystem::is_regular_file(wanted)) return read_text(wanted);
    why = "no such file";
    return std::nullopt;
  };
  loaded.result = load_program(path, read, loaded.diagnostics);
  return loaded;
}

std::vector<Expectation> found(const Loaded& loaded, bool notes) {
  std::vector<Expectation> all;
  for (const Diagnostic& diagnostic : loaded.diagnostics.rows()) {
    if (diagnostic.allowed()) continue;
    if (!notes) all.push_back(expectation_of(loaded.result.files, diagnostic));
    for (const Diagnostic& note : diagnostic.notes)
      if (notes) all.push_back(expectation_of(loaded.result.files, note));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace rg::dsl::golden
