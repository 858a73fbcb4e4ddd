// Compiles again when a file that was read, or looked for, is another one. Polling: works on every file system, and follows editors that rename.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/commands/outputs.h"
#include "compiler/shaders/glslang_front_end.h"

namespace rg::commands {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPoll{20}, kSettled{10};
constexpr int kMostSettling = 20;  // polls, for a file that never comes to rest

struct Mark {  // of a file's contents; zeros: there is none
  uint64_t device = 0, inode = 0, bytes = 0;
  int64_t seconds = 0, nanoseconds = 0;
  friend bool operator==(const Mark&, const Mark&) = default;
};

Mark look(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return {};
  return {static_cast<uint64_t>(about.st_dev), static_cast<uint64_t>(about.st_ino), static_cast<uint64_t>(about.st_size),
          static_cast<int64_t>(about.st_mtim.tv_sec), static_cast<int64_t>(about.st_mtim.tv_nsec)};
}

using Marks = std::map<std::string, Mark>;

// Notes what a file was like right before it was read, so that no change falls between.
class MarkingReader {
 public:
  explicit MarkingReader(const std::string& root) : read_(reader_for(root)) {}
  dsl::ReadSource reader() {
    return [this](const std::string& path, std::string& why) {
      {
        const std::lock_guard lock(mutex_);
        marks_.try_emplace(path, look(path));
      }
      return read_(path, why);
    };
  }
  Marks take() { return std::move(marks_); }

 private:
  dsl::ReadSource read_;
  std::mutex mutex_;
  Marks marks_;
};

bool changed(const Marks& marks) {
  return std::any_of(marks.begin(), marks.end(), [](const auto& entry) { return look(entry.first) != entry.second; });
}

Marks look_again(const Marks& marks) {
  Marks now;
  for (const auto& [path, mark] : marks) now.emplace(path, look(path));
  return now;
}

// Editors truncate, write in pieces and rename: what changed is read when it rests.
void wait_for_change(const Marks& marks) {
  while (!changed(marks)) std::this_thread::sleep_for(kPoll);
  Marks last = look_again(marks);
  for (int i = 0; i < kMostSettling; ++i) {
    std::this_thread::sleep_for(kSettled);
    Marks now = look_again(marks);
    if (now == last) return;
    last = std::move(now);
  }
}

std::string plan_file_of(const WatchOptions& options) {
  return options.plan_file.empty() ? std::filesystem::path(options.file).replace_extension(".rgplan").string() : options.plan_file;
}

void say(const WatchOptions& options, const std::string& text) {
  if (options.quiet) return;
  print(text);
  std::fflush(stdout);
}

bool write_results(const WatchOptions& options, const compiler::GeneratedFile& plans, const compiler::CompileResult& result,
                   dsl::Diagnostics& diagnostics) {
  const bool alone = options.folder.empty() || !result.complete;
  const std::vector<Output> generated = alone ? std::vector<Output>() : outputs_in(options.folder, result.files);
  if (!may_write({{"the plan file", plans.path}}, generated, result.read_files, diagnostics)) return false;
  if (alone) return write_file(plans.path, plans.text, diagnostics);
  return write_output(options.folder, result.files, diagnostics, {plans}, result.read_files).has_value();
}

struct Build {
  Marks marks;  // of what was read
  bool good = false, complete = true;
  std::vector<compiler::SpectrumChoice> kernels;
};

// Writes the files, or says what is wrong and leaves them as they are. With the kernels of an earlier build it may stop at a plan file that is soon
// there.
Build build_once(const WatchOptions& options, const std::vector<compiler::SpectrumChoice>* earlier) {
  const auto start = Clock::now();
  MarkingReader reader(options.file);
  compiler::CompileOptions compile = options.compile;
  if (compile.command.empty()) compile.command = "rgc build " + std::filesystem::path(options.file).filename().string();
  compile.until = options.folder.empty() ? compiler::Until::plans : compiler::Until::files;
  compile.progress = show_progress;
  compile.preview = earlier != nullptr;
  compile.earlier = earlier;
  dsl::Diagnostics diagnostics;
  read_profile(compile, diagnostics);
  compiler::CompileResult result = compiler::compile(options.file, reader.reader(), compile, diagnostics);
  if (compile.preview && diagnostics.has_errors())
    return build_once(options, nullptr);  // haste makes no judgement: what the optimiser drops is still there
  if (!diagnostics.has_errors() && result.program.graphs.empty()) diagnostics.report(dsl::DiagnosticKind::NoGraph, {}, {options.file});
  const std::string path = plan_file_of(options);
  if (!diagnostics.has_errors()) write_results(options, plan_file(path, result), result, diagnostics);
  const bool good = finish(diagnostics, result.sources) == exit_done;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
  say(options, fmt::format("{}: {}, {} ms\n", path, !good ? "left as it is" : result.complete ? "up to date" : "a preview", ms));
  return {reader.take(), good, !good || result.complete, std::move(result.spectra)};
}

// True unless something changes soon: then there is more urgent work than to complete this build.
bool rests(const Marks& marks) {
  constexpr int kPolls = 10;
  for (int i = 0; i < kPolls; ++i) {
    if (changed(marks)) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return !changed(marks);
}

}  // namespace

int watch(const WatchOptions& options) {
  if (!std::filesystem::exists(options.file)) {
    fmt::print(stderr, "watch: there is no file `{}`\n", options.file);
    return exit_input_wrong;
  }
  dsl::Diagnostics diagnostics;
  if (!may_write({{"the plan file", plan_file_of(options)}}, {}, {options.file}, diagnostics)) return finish(diagnostics, {});
  std::vector<compiler::SpectrumChoice> kernels;  // of the last build that chose them
  bool built = false;                             // something runs, so that somebody may wait for the next
  for (;;) {
    Build build = build_once(options, built ? &kernels : nullptr);
    if (!build.complete && rests(build.marks)) build = build_once(options, nullptr);
    if (!built) compiler::warm_front_end();
    if (build.complete && build.good) kernels = std::move(build.kernels), built = true;
    wait_for_change(build.marks);
  }
}

}  // namespace rg::commands
