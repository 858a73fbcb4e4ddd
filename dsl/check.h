// TREES -> PROGRAM: names, types, values, layouts, places, accesses; loops are unrolled and techniques put in place on the way.
#pragma once

#include <string>
#include <vector>

#include "dsl/ast.h"
#include "dsl/diagnostics.h"
#include "dsl/program.h"

namespace rg::dsl {

// One file with what it imports. Modules stand in dependency order: imports first, the root last.
struct Module {
  ast::File tree;
  std::string name;
  std::string folder;             // relative to the root file's folder: "" or "passes/culling/"
  std::vector<uint32_t> imports;  // indices of the modules imported directly
};

Program check(const std::vector<Module>& modules, Diagnostics& diagnostics);

}  // namespace rg::dsl
