// error: use of deleted function .*rg::Required
// A descriptor set the engine owns and does not give.
#include "recorders.h"

recorders::EngineSets sets([[maybe_unused]] VkDescriptorSet materials) {
#ifdef RG_RIGHT
  return {.materials = materials};
#else
  return {};
#endif
}
