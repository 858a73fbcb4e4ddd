// What a benchmark gives: rows of name, value, unit and, where there is something to compare with, a reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rg::bench {

struct Row {
  std::string name;  // "planner/G1/heap"
  double value = 0;
  std::string unit;  // ms us MB count
  std::optional<double> reference;
  std::string note;  // what the reference is
};
using Rows = std::vector<Row>;

// Graphs as .rg files are read from `graphs`; see bench/README.md for how ./x bench makes them.
Rows bench_planner(const std::string& graphs);
Rows bench_front_end(const std::string& graphs);
Rows bench_checker(const std::string& graphs);
Rows bench_executor(const std::string& graphs);
// Needs no graphs. RGC_PACKING may name a folder of packing problems.
Rows bench_packing(const std::string& graphs);
Rows bench_runtime(const std::string& graphs);
Rows bench_variants(const std::string& graphs);  // reads bench/shaders and passes.rg: run it in the root folder
Rows bench_frame(const std::string& graphs);     // likewise; needs a Vulkan device
Rows bench_creation(const std::string& graphs);  // needs a Vulkan device and no graphs

// Median of `runs` wall-clock times of `work`, in milliseconds; the first run warms up and is not counted.
template <class Work>
double median_ms(int runs, Work work);

// Wall-clock time of one run that nothing warms up, in milliseconds: for work of seconds.
template <class Work>
double once_ms(Work work);

// Processor time of this process and of the children it has waited for, in milliseconds: what else the machine does counts less.
double spent_ms();
template <class Work>
double cpu_ms(Work work);
template <class Work>
double median_cpu_ms(int runs, Work work);  // the first run warms up and is not counted

}  // namespace rg::bench

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

inline double rg::bench::spent_ms() {
  double ms = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    struct rusage use {};
    getrusage(who, &use);
    for (const timeval& time : {use.ru_utime, use.ru_stime}) ms += static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
  }
  return ms;
}

template <class Work>
double rg::bench::cpu_ms(Work work) {
  const double begin = spent_ms();
  work();
  return spent_ms() - begin;
}

template <class Work>
double rg::bench::median_cpu_ms(int runs, Work work) {
  work();
  std::vector<double> times;
  for (int run = 0; run < runs; ++run) times.push_back(cpu_ms(work));
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

template <class Work>
double rg::bench::median_ms(int runs, Work work) {
  std::vector<double> times;
  for (int run = 0; run <= runs; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (run > 0) times.push_back(took.count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

template <class Work>
double rg::bench::once_ms(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}
