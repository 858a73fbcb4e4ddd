#include "examples/demo/inspect.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "examples/demo/dump_file.h"
#include "runtime/plan_interface.h"
#include "runtime/profile.h"

namespace rg::demo {
namespace {

template <class Row>
std::string names_of(std::span<const Row> rows) {
  std::string text;
  for (const Row& row : rows) text += (text.empty() ? "" : ", ") + std::string(row.name);
  return text;
}

Status write_text(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".tmp";
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  std::error_code failed;
  if (file) std::filesystem::rename(temporary, path, failed);
  if (!file || failed) return Error{ErrorCode::io, "`" + path + "` cannot be written"};
  std::printf("wrote %s\n", path.c_str());
  return Done{};
}

}  // namespace

Result<DumpPoint> find_dump(const Plan& plan, const std::string& text) {
  // Names of both may have dots in them: the pass is the longest that there is.
  size_t dot = text.find('.'), end = std::string::npos;
  if (dot == std::string::npos) return Error{ErrorCode::invalid_argument, "`" + text + "` is not of the form PASS.resource"};
  const std::string first = text.substr(0, dot);
  DumpPoint point;
  for (; dot != std::string::npos; dot = text.find('.', dot + 1)) {
    const Index pass = find_pass(plan, text.substr(0, dot));
    if (pass != kNone) point.pass = pass, end = dot;
  }
  if (point.pass == kNone) return Error{ErrorCode::invalid_argument, "there is no pass `" + first + "`; there are " + names_of(plan.passes)};
  point.resource = find_resource(plan, text.substr(end + 1));
  if (point.resource == kNone)
    return Error{ErrorCode::invalid_argument, "there is no resource `" + text.substr(end + 1) + "`; there are " + names_of(plan.resources)};
  return point;
}

namespace {

// All of one frame.
Status write_dumps(GraphInstance& graph, const DemoOptions& options, const std::function<Status()>& draw) {
  if (options.dumps.empty()) return Done{};
  for (const std::string& text : options.dumps) {
    const auto point = find_dump(frame::plan(), text);
    if (!point) return point.error();
    if (Status asked = graph.request_dump(point->pass, point->resource); !asked) return asked;
  }
  if (Status drawn = draw(); !drawn) return drawn;
  for (const std::string& text : options.dumps) {
    const auto dump = graph.take_dump();
    if (!dump) return dump.error();
    const auto files = write_dump(options.out, text, *dump);
    if (!files) return files.error();
    for (const std::string& file : *files) std::printf("wrote %s\n", file.c_str());
  }
  return Done{};
}

}  // namespace

Status inspect(Renderer& renderer, const DemoOptions& options, const std::function<Status()>& draw) {
  GraphInstance& graph = renderer.graph().instance();
  if (Status dumped = write_dumps(graph, options, draw); !dumped) return dumped;
  ChromeTrace trace;
  for (uint32_t number = 0; number < 3 && !options.trace.empty(); ++number) {
    if (Status drawn = draw(); !drawn) return drawn;
    trace.add(graph);
  }
  if (!options.trace.empty())
    if (Status written = write_text(options.trace, trace.json()); !written) return written;
  if (options.profile.empty()) return Done{};
  if (Status drawn = draw(); !drawn) return drawn;
  if (Status idle = graph.wait_idle(); !idle) return idle;
  return write_text(options.profile, profile_json(graph));
}

}  // namespace rg::demo
