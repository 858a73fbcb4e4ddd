#include "examples/demo/watch.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

namespace rg::demo {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// Pictures follow edits within a frame; between edits the demo has nothing to do.
constexpr std::chrono::milliseconds kPoll{10};

Status reload(Renderer& renderer, Result<PlanFile>& loaded, const std::function<Status()>& take) {
  if (!loaded) return loaded.error();
  const auto start = std::chrono::steady_clock::now();
  if (Status reloaded = renderer.reload(*loaded); !reloaded) return reloaded;
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::printf("reloaded in %.0f ms\n", ms);
  return take();
}

}  // namespace

Status watch(Renderer& renderer, const DemoOptions& options, const std::function<Status()>& take) {
  PlanWatch changes(options.watch);
  std::signal(SIGINT, [](int) { interrupted = 1; });
  std::signal(SIGTERM, [](int) { interrupted = 1; });
  if (Status taken = take(); !taken) return taken;
  std::printf("watching %s\n", options.watch.c_str());
  std::fflush(stdout);
  for (uint32_t attempts = 0; interrupted == 0 && (options.reloads == 0 || attempts < options.reloads);) {
    std::optional<Result<PlanFile>> loaded = changes.poll();
    if (!loaded) {
      std::this_thread::sleep_for(kPoll);
      continue;
    }
    ++attempts;
    // A lost device is final; a plan that does not fit is not.
    if (Status done = reload(renderer, *loaded, take); !done) {
      if (done.error().code == ErrorCode::device_lost) return done;
      std::fprintf(stderr, "the old plan goes on: %s\n", done.error().message.c_str());
    }
    std::fflush(stdout);
  }
  return Done{};
}

}  // namespace rg::demo
