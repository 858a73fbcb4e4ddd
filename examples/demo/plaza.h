// The procedural scene of the demo: a courtyard at dusk. Arcades on four sides, a fountain, steps to a hall that can be entered,
// several hundred lamps. The same on every machine.
#pragma once

#include "examples/demo/scene.h"

namespace rg::demo {

// At least 200 meshes, 20 materials, both vertex layouts, 100,000 triangles; cameras `courtyard`, `interior`, `overview`.
Scene make_plaza();

}  // namespace rg::demo
