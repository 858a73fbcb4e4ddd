// A pass with a spectrum becomes the passes that run it. For `pass shade : compute { spectrum S by masks ... }` with kernels of sets k0, k1, ...:
//
//   shade.reset     : transfer    the counts of all lists become 0
//   shade.classify  : compute     one invocation a group of the grid: the first kernel whose set holds the group's mask, and the group into its list
//   shade[0], ...   : compute     indirect; one workgroup a listed group, the features of its set as constants; between them nothing waits
//
// with a buffer `shade.arguments` (three u32 a kernel), a buffer `shade.tiles` (the lists, x | y << 16) and an image of the grid, which shows what
// each group got: that of `into`, else one of its own, `shade.modes`. The shader asks spectrum_tile() and spectrum_pixel() where it would have looked
// at gl_WorkGroupID and gl_GlobalInvocationID.
#pragma once

#include <string>
#include <vector>

#include "compiler/spectrum/cost_model.h"
#include "dsl/program.h"

namespace rg::compiler {

// What a shader adds to its features in a kernel; see expand_spectra.cpp.
struct KernelSets {
  dsl::SpectrumId spectrum;
  std::vector<Mask> sets;           // in the order in which they are tried; the last one holds every feature
  std::vector<double> shares = {};  // of all groups, by set; empty: not known, each may get all of them
};

// Replaces every pass with a spectrum. Spectra that no row of `kernels` names keep their passes.
dsl::Program expand_spectra(dsl::Program program, const std::vector<KernelSets>& kernels);

// "shade[2]": the pass of kernel 2.
std::string kernel_name(const std::string& pass, size_t kernel);

}  // namespace rg::compiler
