#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "dsl/diagnostics.h"
#include "dsl/visible.h"

namespace rg::dsl {
namespace {

using Json = nlohmann::ordered_json;

struct Writer {
  const SourceFiles& files;
  Json rules = Json::array();
  std::map<std::string_view, size_t> rule_index;  // by code
  bool suppresses = false;                        // some result is: then each has to say
};

bool has_place(const SourceFiles& files, Span span) { return span.file.valid() && span.file.value < files.size(); }

const char* level_of(Severity severity) {
  constexpr const char* kLevels[] = {"error", "warning", "note"};
  return kLevels[static_cast<size_t>(severity)];
}

// What is not plain in a URI reference is percent-encoded.
std::string uri_of(const std::string& path) {
  constexpr const char* kHex = "0123456789ABCDEF";
  std::string uri;
  for (const char c : path) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::string_view("/._-~").find(c) != std::string_view::npos;
    const auto byte = static_cast<unsigned char>(c);
    uri += plain ? std::string(1, c) : std::string{'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return uri;
}

// SARIF knows no bytes: code points of the line, from 1.
size_t column_of(const SourceFile& file, uint32_t offset) {
  const uint32_t bytes = file.position(offset).column - 1;
  return 1 + code_points(std::string_view(file.text).substr(offset - bytes, bytes));
}

Json region(const SourceFile& file, Span span) {
  const Position begin = file.position(span.begin), end = file.position(span.end);
  return {{"startLine", begin.line}, {"startColumn", column_of(file, span.begin)}, {"endLine", end.line}, {"endColumn", column_of(file, span.end)}};
}

Json artifact(const SourceFile& file) { return {{"uri", uri_of(file.path)}}; }

Json location(const SourceFiles& files, Span span) {
  const SourceFile& file = files[span.file];
  return {{"physicalLocation", {{"artifactLocation", artifact(file)}, {"region", region(file, span)}}}};
}

size_t rule_of(Writer& writer, const DiagnosticRow& info) {
  const auto [at, fresh] = writer.rule_index.emplace(info.code, writer.rules.size());
  if (fresh)
    writer.rules.push_back({{"id", info.code},
                            {"name", info.name},
                            {"shortDescription", {{"text", info.message}}},
                            {"help", {{"text", "rgc explain " + std::string(info.code)}}},
                            {"defaultConfiguration", {{"level", level_of(info.severity)}}}});
  return at->second;
}

Json related(const Writer& writer, const Diagnostic& diagnostic) {
  Json all = Json::array();
  for (const Diagnostic& note : diagnostic.notes) {
    if (!has_place(writer.files, note.span)) continue;
    Json entry = {{"id", all.size() + 1}};
    entry.update(location(writer.files, note.span));
    entry["message"] = {{"text", note.message()}};
    all.push_back(std::move(entry));
  }
  return all;
}

Json fix(const Writer& writer, const FixIt& fix) {
  const SourceFile& file = writer.files[fix.span.file];
  const Json replacement = {{"deletedRegion", region(file, fix.span)}, {"insertedContent", {{"text", fix.text}}}};
  return {{"artifactChanges", Json::array({{{"artifactLocation", artifact(file)}, {"replacements", Json::array({replacement})}}})}};
}

Json fixes(const Writer& writer, const Diagnostic& diagnostic) {
  Json all = Json::array();
  for (const FixIt& each : diagnostic.fixes)
    if (has_place(writer.files, each.span)) all.push_back(fix(writer, each));
  return all;
}

Json suppressions(const Writer& writer, const Diagnostic& diagnostic) {
  if (!diagnostic.allowed()) return Json::array();
  const bool here = diagnostic.standing == Standing::allowed_here;
  Json one = {{"kind", here ? "inSource" : "external"}};
  if (here && has_place(writer.files, diagnostic.allowed_at)) one["location"] = location(writer.files, diagnostic.allowed_at);
  return Json::array({std::move(one)});
}

Json result(Writer& writer, const Diagnostic& diagnostic) {
  const DiagnosticRow& info = row(diagnostic.kind);
  Json json = {{"ruleId", info.code}, {"ruleIndex", rule_of(writer, info)}, {"level", level_of(diagnostic.severity())}};
  std::string text = diagnostic.message();
  for (const Diagnostic& note : diagnostic.notes)
    if (!has_place(writer.files, note.span)) text += "; " + note.message();
  json["message"] = {{"text", text}};
  json["locations"] = Json::array();
  if (has_place(writer.files, diagnostic.span)) json["locations"].push_back(location(writer.files, diagnostic.span));
  if (Json places = related(writer, diagnostic); !places.empty()) json["relatedLocations"] = std::move(places);
  if (Json changes = fixes(writer, diagnostic); !changes.empty()) json["fixes"] = std::move(changes);
  if (writer.suppresses) json["suppressions"] = suppressions(writer, diagnostic);
  return json;
}

}  // namespace

std::string print_sarif(const Diagnostics& diagnostics, const SourceFiles& files) {
  const std::vector<Diagnostic> shown = first_of(diagnostics, kMostForPrograms, true);
  Writer writer{files, Json::array(), {}, std::any_of(shown.begin(), shown.end(), [](const Diagnostic& each) { return each.allowed(); })};
  Json results = Json::array();
  for (const Diagnostic& diagnostic : shown) results.push_back(result(writer, diagnostic));
  const Json driver = {{"name", "rgc"}, {"rules", writer.rules}};
  const Json run = {{"tool", {{"driver", driver}}}, {"columnKind", "unicodeCodePoints"}, {"results", std::move(results)}};
  const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", Json::array({run})}};
  return log.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rg::dsl
