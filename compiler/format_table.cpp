#include "compiler/format_table.h"

namespace rg::compiler {
namespace {

enum class Numeric : char { F = 'F', N = 'N', M = 'M', U = 'U', I = 'I', B = 'B', G = 'G' };

constexpr FormatRow kFormats[] = {
    {},
#define RG_FORMAT(name, number, kind, bytes, width, height, aspects, numeric) \
  {static_cast<Format>(number), bytes, width, height, aspects, Numeric::numeric == Numeric::U || Numeric::numeric == Numeric::I},
#include "dsl/format.def"
#undef RG_FORMAT
};

}  // namespace

const FormatRow& format_row(dsl::Format format) { return kFormats[static_cast<size_t>(format)]; }

}  // namespace rg::compiler
