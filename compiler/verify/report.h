// Collects findings, each once, up to a limit.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compiler/verify/verify.h"

namespace rg::verify {

class Report {
 public:
  explicit Report(size_t limit) : limit_(limit) {}
  void add(Finding finding);
  bool full() const { return findings_.size() >= limit_; }
  bool empty() const { return findings_.empty(); }
  std::vector<Finding> take() { return std::move(findings_); }

 private:
  size_t limit_;
  std::vector<Finding> findings_;
  std::set<std::string> seen_;
};

}  // namespace rg::verify
