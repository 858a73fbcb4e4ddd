// What the planner needs to know of a format.
#pragma once

#include "dsl/program.h"
#include "runtime/plan.h"

namespace rg::compiler {

struct FormatRow {
  Format vulkan = Format::undefined;
  uint32_t block_bytes = 0, block_width = 1, block_height = 1, aspects = 0;
  bool integer = false;
};
const FormatRow& format_row(dsl::Format format);

}  // namespace rg::compiler
