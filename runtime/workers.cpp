#include "runtime/workers.h"

#include <system_error>

#include "runtime/graph_state.h"

namespace rg {

Workers::Workers(uint32_t helpers, Missing missing) {
  helpers_.reserve(helpers);
  try {
    while (helpers_.size() < helpers) helpers_.emplace_back([this] { help(); });
  } catch (const std::system_error&) {
    if (missing == Missing::done_without) return;
    stop();  // no destructor follows
    throw;
  }
}

Workers::~Workers() { stop(); }

void Workers::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Workers::take_jobs(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const uint32_t index = next_++;
    lock.unlock();
    job_(data_, index);
    lock.lock();
    if (--unfinished_ == 0) done_.notify_one();
  }
}

void Workers::help() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    take_jobs(lock);
    if (!stop_) work_.wait(lock, [this] { return stop_ || next_ < count_; });
  }
}

void Workers::run(uint32_t count, Job job, void* data) {
  std::unique_lock lock(mutex_);
  job_ = job, data_ = data, next_ = 0, count_ = unfinished_ = count;
  work_.notify_all();
  take_jobs(lock);
  done_.wait(lock, [this] { return unfinished_ == 0; });
}

void WorkersDeleter::operator()(Workers* workers) const { delete workers; }

}  // namespace rg
