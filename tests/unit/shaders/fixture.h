// A small program built by hand, and shader files held in memory.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "compiler/shaders/shaders.h"
#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::compiler {

inline const std::string kRootText =
    "module frame\n"
    "graph frame {\n"
    "  pass work : compute {\n"
    "    shader \"work.comp\" group 8 8 1\n"
    "    read depth as sampled\n"
    "    write hdr as storage\n"
    "  }\n"
    "}\n";

struct Fixture {
  dsl::Program program;
  dsl::SourceFiles files;
  dsl::Diagnostics diagnostics;
  std::map<std::string, std::string> shaders;
  dsl::GraphId graph_id;

  Fixture() {
    files.add(dsl::SourceFile("passes.rg", kRootText));
    program.module = "frame";
    graph_id = program.graphs.add({});
    graph().name = "frame";
  }
  dsl::Graph& graph() { return program.graphs[graph_id]; }
  dsl::Span span(const std::string& text) const {
    const auto at = static_cast<uint32_t>(kRootText.find(text));
    return {dsl::FileId{0}, at, at + static_cast<uint32_t>(text.size())};
  }
  dsl::ResourceId image(const std::string& name, dsl::Format format) {
    dsl::Resource resource;
    resource.name = name;
    resource.format = format;
    return graph().resources.add(resource);
  }
  dsl::ResourceId buffer(const std::string& name, dsl::Type element) {
    dsl::Resource resource;
    resource.name = name;
    resource.kind = dsl::ResourceKind::buffer;
    resource.element = element;
    return graph().resources.add(resource);
  }
  dsl::Access access(dsl::ResourceId id, dsl::Mode mode, dsl::Role role) {
    dsl::Access access;
    access.resource = id;
    access.mode = mode;
    access.role = role;
    access.name = graph().resources[id].name;
    access.span = span(mode == dsl::Mode::read ? "read depth as sampled" : "write hdr as storage");
    return access;
  }
  dsl::Pass& compute(std::vector<dsl::Access> accesses, const std::string& text) {
    dsl::Pass pass;
    pass.name = "work";
    pass.span = span("work");
    pass.shaders = {{dsl::stage_compute, "work.comp", span("shader \"work.comp\"")}};
    pass.dispatch.group[0] = pass.dispatch.group[1] = 8;
    pass.accesses = std::move(accesses);
    shaders["work.comp"] = text;
    return graph().passes[graph().passes.add(pass)];
  }
  dsl::Pass& raster(std::vector<dsl::Access> accesses, const std::string& vertex, const std::string& fragment) {
    dsl::Pass pass;
    pass.name = "draw";
    pass.kind = dsl::PassKind::raster;
    pass.span = span("work");
    if (!vertex.empty()) pass.shaders.push_back({dsl::stage_vertex, "draw.vert", span("shader \"work.comp\"")});
    if (!fragment.empty()) pass.shaders.push_back({dsl::stage_fragment, "draw.frag", span("shader \"work.comp\"")});
    pass.accesses = std::move(accesses);
    shaders["draw.vert"] = vertex;
    shaders["draw.frag"] = fragment;
    return graph().passes[graph().passes.add(pass)];
  }
  ShaderBundle compile() {
    const ReadFile read = [this](const std::string& path, std::string& why) -> std::optional<std::string> {
      const auto found = shaders.find(path);
      why = "no such file";
      return found == shaders.end() ? std::nullopt : std::optional(found->second);
    };
    return compile_shaders(program, graph_id, initial_variants(program, graph_id), read, files, {}, diagnostics);
  }
  // "RG0403 passes.rg:5:5 `depth` is declared by ..." one line each, notes indented.
  std::string report() const {
    std::string text;
    for (const dsl::Diagnostic& diagnostic : diagnostics.rows()) {
      text += line(diagnostic) + "\n";
      for (const dsl::Diagnostic& note : diagnostic.notes) text += "  " + line(note) + "\n";
    }
    return text;
  }
  std::string line(const dsl::Diagnostic& diagnostic) const {
    std::string place = "-";
    if (diagnostic.span.file.valid()) {
      const dsl::Position at = files[diagnostic.span.file].position(diagnostic.span.begin);
      place = files[diagnostic.span.file].path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
    }
    return std::string(dsl::row(diagnostic.kind).code) + " " + place + " " + diagnostic.message();
  }
};

}  // namespace rg::compiler
