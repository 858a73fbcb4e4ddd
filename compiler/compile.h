// The whole compiler as one function. compile.cpp is its table of contents.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/codegen/generate.h"
#include "compiler/fold_transfers.h"
#include "compiler/fusion/fuse_passes.h"
#include "compiler/plan_frame.h"
#include "compiler/shaders/cache.h"
#include "compiler/shaders/shaders.h"
#include "compiler/spectrum/resolve_spectra.h"
#include "dsl/diagnostics.h"
#include "dsl/front_end.h"

namespace rg::compiler {

enum class Until : uint8_t { program, shaders, plans, files };

struct CompileOptions {
  Until until = Until::files;
  PlanOptions plan;
  std::string profile, profile_text;        // a file of measured times, see compiler/pass_cost.h, and what is in it; empty: none
  std::vector<std::string> fixed_features;  // `-D fog=off`: static features, each "NAME=VALUE"
  size_t max_plans = 64;                    // feature configurations of one graph
  std::string cache_folder;                 // of compiled shaders, see shaders/cache.h; empty: none
  uint64_t cache_bytes = kDefaultCacheBytes;
  unsigned workers = 0;                                  // threads that compile shaders; 0: one a core
  unsigned shard = 0, shards = 0;                        // more than 0 shards: only this part of the shaders, into the cache, and nothing else
  bool list_tasks = false;                               // fills CompileResult::tasks and stops there
  std::string spectrum_profile;                          // replaces the profiles of all spectra; empty: their own
  dsl::ReadSource read_profile;                          // reads that file; empty: the reader of the sources
  std::optional<uint32_t> spectrum_modes;                // replaces their numbers of kernels
  std::vector<std::string> forced_features;              // of spectra: on in every mask
  bool preview = false;                                  // soon rather than good, see ShaderEffort; CompileResult::complete says what it came to
  const std::vector<SpectrumChoice>* earlier = nullptr;  // for a preview: of an earlier build, see SpectrumOptions::earlier
  bool fuse = true;                                      // false: every block is a kernel of its own
  HalfRounding halves = HalfRounding::zero;              // of images on the devices this is for; see fusion/conversions.h
  dsl::WarningPolicy warnings;                           // `--allow CODE`, `--deny CODE`
  std::string command;                                   // as it shall stand in the banner of generated files
  std::function<void(std::string_view)> progress;        // what is being worked on, for a person; may be empty
};

// One graph: its shaders, and a plan for each feature configuration.
struct CompiledGraph {
  dsl::GraphId graph;
  ShaderBundle shaders;
  std::vector<FramePlan> plans;               // by configuration
  std::vector<Configuration> configurations;  // of the features it depends on
  VariantSpace space;                         // which shader variants they can select
};

struct CompileResult {
  dsl::SourceFiles sources;             // sources[0] is the root file; diagnostics point into them
  dsl::Program program;                 // spectra expanded and every Access::stages resolved, from Until::shaders on
  std::vector<SpectrumChoice> spectra;  // what serves which masks, and why
  dsl::Program written;                 // the program before its blocks became kernels
  std::vector<FusedKernel> fused;
  std::vector<FusionRefusal> not_fused;
  dsl::Program unfolded;  // the program with kernels, before renderings took in passes that clear and resolve
  std::vector<Fold> folded;
  std::vector<FoldRefusal> not_folded;
  std::vector<CompiledGraph> graphs;    // in order of declaration
  std::vector<GeneratedFile> files;     // paths relative to the output folder
  std::vector<std::string> read_files;  // the root file, then sources, shaders and profiles by name: for depfiles, and not to be written to
  std::vector<ShaderTask> tasks;        // of all graphs, where they were asked for
  ShaderCache::Counts cache;            // what the cache gave and took
  bool complete = true;                 // false: it runs and draws the same, but was made in a hurry, or for kernels that are to be chosen anew
};

// Reads `root_path` and everything it names. After an error was reported the later tables are empty.
CompileResult compile(const std::string& root_path, const dsl::ReadSource& read, const CompileOptions& options, dsl::Diagnostics& diagnostics);

}  // namespace rg::compiler
