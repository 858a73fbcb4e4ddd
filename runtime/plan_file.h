// Plans as data: read from a file that `rgc build --plan-file` or `rgc watch` wrote, for hot reload and for tools. Nothing in a file is trusted.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/plan.h"
#include "runtime/result.h"

namespace rg {

// Immutable. Owns what its plans point to: keep it while an instance runs one of them. Copies share. Any thread.
class PlanFile {
 public:
  // Refuses, with `invalid_plan` and a message that names `name`: another version, another shape of plan.h, damaged or missing bytes, and plans that
  // check_plan refuses. Cost: O(bytes); memory at most a small multiple of them.
  static Result<PlanFile> parse(std::span<const std::byte> bytes, std::string_view name);
  // `io` where the file cannot be read; a file of more than 256 MiB is refused.
  static Result<PlanFile> read(const std::string& path);

  std::span<const Plan> plans() const;  // of every graph and every feature configuration, in the compiler's order
  // The plan of that graph and configuration (`Plan::name`, `Plan::variant_name`); null: there is none.
  const Plan* find(std::string_view graph, std::string_view variant = {}) const;

 private:
  struct State;
  explicit PlanFile(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

// Looks whether a plan file was replaced. Editors and compilers that rename, truncate or rewrite are all noticed; one thread.
//
//   for (;;) {
//     if (auto loaded = watch.poll()) loaded->... // at a frame boundary: reload, or report the error and go on
//     frame->execute(...);
//   }
class PlanWatch {
 public:
  // What the file holds now counts as known: the first poll reports it only if `report_first`.
  explicit PlanWatch(std::string path, bool report_first = false);
  // Nothing while the file is as it was when last looked at, or does not exist; else its plans, or why they are refused, each once. Cost: one stat.
  std::optional<Result<PlanFile>> poll();

 private:
  struct Mark {
    uint64_t device = 0, inode = 0, bytes = 0;
    int64_t seconds = 0, nanoseconds = 0;
    friend bool operator==(const Mark&, const Mark&) = default;
  };
  std::optional<Mark> look() const;
  std::string path_;
  std::optional<Mark> seen_;
};

}  // namespace rg
