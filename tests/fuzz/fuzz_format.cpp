// Any bytes through the formatter: it refuses them, or gives text that it leaves as it is. (That only blanks change, format() checks itself.)
#include <cstdint>

#include "dsl/check_macro.h"
#include "dsl/format.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rg::dsl::Diagnostics diagnostics;
  const rg::dsl::FileId file{size_t{0}};
  const auto once = rg::dsl::format(file, text, diagnostics);
  if (once) RG_CHECK(rg::dsl::format(file, *once, diagnostics) == once, "formatting is idempotent");
  return 0;
}
