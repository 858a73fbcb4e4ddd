// Graphs on a device that only writes down its calls.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/device.h"
#include "runtime/graph.h"
#include "tests/unit/runtime/test_plan.h"

namespace rg::test {

inline std::vector<std::string> lines(std::string_view log) {
  std::vector<std::string> result;
  while (!log.empty()) {
    const size_t end = std::min(log.find('\n'), log.size());
    result.emplace_back(log.substr(0, end));
    log.remove_prefix(std::min(end + 1, log.size()));
  }
  return result;
}

// The lines that begin with `name`.
inline std::vector<std::string> calls(std::string_view log, std::string_view name) {
  std::vector<std::string> result;
  for (const std::string& line : lines(log))
    if (line.starts_with(name)) result.push_back(line);
  return result;
}

class NullTest : public testing::Test {
 protected:
  // Fails the test and aborts on error: the plan is meant to work.
  GraphInstance make(TestPlan& plan, const GraphOptions& options = {}) {
    Result<GraphInstance> graph = GraphInstance::create(device, plan.view(), options);
    if (!graph) ADD_FAILURE() << graph.error().message;
    log.clear();
    return std::move(*graph);
  }
  // What one frame records and submits.
  std::string frame(GraphInstance& graph, const FrameInputs& inputs = {}) {
    log.clear();
    const Status status = graph.execute(inputs);
    if (!status) ADD_FAILURE() << status.error().message;
    return log;
  }

  std::string log;
  Device device = Device::null(&log);
};

inline std::string message(const Status& status) { return status ? "no error" : status.error().message; }

}  // namespace rg::test
