// Threads that record parts of a frame, or make pipelines, together with the caller.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace rg {

class Workers {
 public:
  using Job = void (*)(void* data, uint32_t index);
  enum class Missing { thrown, done_without };  // helpers that the system refuses: std::system_error, or there are fewer
  explicit Workers(uint32_t helpers, Missing missing = Missing::thrown);
  ~Workers();  // idle: run() has returned
  // Calls job(data, i) once for every i below `count`, on the helpers and on the caller; returns when all are done. Allocates nothing.
  void run(uint32_t count, Job job, void* data);

 private:
  void help();
  void stop();
  void take_jobs(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable work_, done_;
  Job job_ = nullptr;
  void* data_ = nullptr;
  uint32_t next_ = 0, count_ = 0, unfinished_ = 0;
  bool stop_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace rg
