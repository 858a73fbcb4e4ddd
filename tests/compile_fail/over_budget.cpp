// error: static assertion failed
// A budget on the figures of the plan.
#include "recorders.h"

#ifdef RG_RIGHT
constexpr uint32_t kMostPasses = 1000;
#else
constexpr uint32_t kMostPasses = 1;
#endif
static_assert(recorders::kFigures.passes <= kMostPasses);
