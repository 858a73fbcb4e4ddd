// Random programs as the front end would give them: every read has a reaching definition, whatever the conditions.
#pragma once

#include <cstdint>

#include "dsl/program.h"

namespace rg::verify {

struct RandomShape {
  uint32_t passes = 20, images = 6, buffers = 4;
  uint32_t conditions = 2;
  bool continues = false;  // half of the raster passes draw into the attachments of the one before
  bool folds = false;      // passes of their own clear what raster passes load, and resolve what they drew
};
// One graph with a surface, transients with mips, layers and depth, histories, persistent and imported resources, read-backs; compute, raster and
// transfer passes, conditional ones, atomics, `disjoint` writers, `after`, orders and permissions of queues. The same seed gives the same program.
dsl::Program make_random_program(uint64_t seed, const RandomShape& shape);

}  // namespace rg::verify
