// Shared by the files that check a plan.
#pragma once

#include <string>

#include "runtime/plan_check.h"

namespace rg::plan_check {

// Collects the first fault; later calls are free.
class Checker {
 public:
  explicit Checker(const Plan& plan) : plan_(plan) {}

  void that(bool holds, std::string_view table, size_t row, std::string_view what) {
    if (holds || !fault_.empty()) return;
    fault_.append("plan `").append(plan_.name).append("`: ").append(table).append(" ").append(std::to_string(row)).append(": ").append(what);
  }
  void index(Index value, size_t size, std::string_view table, size_t row, std::string_view what) { that(value < size, table, row, what); }
  void optional(Index value, size_t size, std::string_view table, size_t row, std::string_view what) {
    that(value == kNone || value < size, table, row, what);
  }
  void range(Index first, uint32_t count, size_t size, std::string_view table, size_t row, std::string_view what) {
    that(first <= size && count <= size - first, table, row, what);
  }
  void expr(Index value, std::string_view table, size_t row, std::string_view what) { optional(value, plan_.exprs.size(), table, row, what); }
  void ref(Ref value, ResourceKind kind, std::string_view table, size_t row, std::string_view what) {
    index(value.resource, plan_.resources.size(), table, row, what);
    if (ok()) that(plan_.resources[value.resource].kind == kind, table, row, what);
  }
  void any_ref(Ref value, std::string_view table, size_t row) { index(value.resource, plan_.resources.size(), table, row, "resource"); }
  void bytes(const Bytes& value, std::string_view table, size_t row) {
    expr(value.offset, table, row, "byte offset");
    expr(value.size, table, row, "byte size");
  }
  bool ok() const { return fault_.empty(); }
  Status status() const { return ok() ? Status(Done{}) : Status(Error{ErrorCode::invalid_plan, fault_}); }

 private:
  const Plan& plan_;
  std::string fault_;
};

// Queues, batches, waits, signals, ownership: that the frame can be submitted in listed order and ends on every queue. Needs indices in bounds
// everywhere but in its own tables.
void check_schedule(const Plan& plan, Checker& checker);

}  // namespace rg::plan_check
