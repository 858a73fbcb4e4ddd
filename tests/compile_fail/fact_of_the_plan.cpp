// error: static assertion failed
// Facts about passes and resources of the plan, as engine tests would state them.
#include "recorders.h"

using namespace recorders;
static_assert(rg::lifetime(kResourceFigures[0]) >= 1);
static_assert(kShaderFigures[pass::meshes].instructions > 0 && kShaderFigures[pass::meshes].shared_bytes == 0);
static_assert(!rg::share_bytes(kResourceFigures[0], rg::ResourceFigures{}));

#ifdef RG_RIGHT
static_assert(rg::runs_before(kPassFigures[0], kPassFigures[1]));
#else
static_assert(rg::runs_before(kPassFigures[1], kPassFigures[0]));
#endif
