// Our own bugs stop the program: RG_CHECK(holds, "what was expected") prints the message and the place, and aborts.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace rg {
[[noreturn]] inline void check_failed(const char* condition, const char* message, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal error: %s (%s)\n", file, line, message, condition);
  std::abort();
}
}  // namespace rg

#define RG_CHECK(condition, message) ((condition) ? static_cast<void>(0) : ::rg::check_failed(#condition, message, __FILE__, __LINE__))
