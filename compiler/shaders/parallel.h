// Work on every index, on several threads; who does what never shows in the results, because each has its own place.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace rg::compiler {

// "what 12 of 256, 3 s left" on `progress`, from the calling thread only and not more often than every 50 ms.
class ProgressLine {
 public:
  ProgressLine(std::string what, size_t count, const std::function<void(std::string_view)>& progress)
      : what_(std::move(what)), count_(count), progress_(progress), start_(Clock::now()), last_(start_) {}
  void show(size_t done) {
    const auto now = Clock::now();
    if (!progress_ || done == 0 || now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    const double spent = std::chrono::duration<double>(now - start_).count();
    const auto left = static_cast<long>(spent / static_cast<double>(done) * static_cast<double>(count_ - done) + 0.5);
    progress_(what_ + " " + std::to_string(done) + " of " + std::to_string(count_) + ", " + std::to_string(left) + " s left");
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  size_t count_;
  const std::function<void(std::string_view)>& progress_;
  Clock::time_point start_, last_;
};

// work(i) for i in [0, count), on `workers` threads (0: one a core), this one among them.
template <class Work>
void for_each_parallel(size_t count, unsigned workers, ProgressLine progress, Work work) {
  const size_t wanted = workers != 0 ? workers : std::max(1u, std::thread::hardware_concurrency());
  std::atomic<size_t> next = 0, done = 0;
  const auto run = [&](ProgressLine* line) {
    for (size_t i = next++; i < count; i = next++) {
      work(i);
      ++done;
      if (line != nullptr) line->show(done);
    }
  };
  std::vector<std::thread> others;
  for (size_t i = 1; i < std::min(wanted, count); ++i) others.emplace_back(run, nullptr);
  run(&progress);
  for (std::thread& other : others) other.join();
}

}  // namespace rg::compiler
