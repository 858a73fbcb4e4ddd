#include "compiler/verify/report.h"

namespace rg::verify {

void Report::add(Finding finding) {
  if (full() || !seen_.insert(finding.text).second) return;
  findings_.push_back(std::move(finding));
}

const char* name(Hazard hazard) {
  switch (hazard) {
    case Hazard::read_after_write:
      return "read-after-write";
    case Hazard::write_after_read:
      return "write-after-read";
    case Hazard::write_after_write:
      return "write-after-write";
    case Hazard::wrong_layout:
      return "wrong layout";
    case Hazard::poison_read:
      return "poison read";
    case Hazard::wrong_version:
      return "wrong version";
    case Hazard::lost_contents:
      return "lost contents";
    case Hazard::alias_race:
      return "alias race";
    case Hazard::invalid_barrier:
      return "invalid barrier";
    case Hazard::boundary_mismatch:
      return "boundary mismatch";
    case Hazard::ownership:
      return "ownership";
    case Hazard::submission:
      return "submission";
    case Hazard::missing_pass:
      return "missing pass";
    case Hazard::order:
      return "order";
    case Hazard::invalid_plan:
      return "invalid plan";
    case Hazard::redundant:
      return "redundant";
  }
  return "?";
}

}  // namespace rg::verify
