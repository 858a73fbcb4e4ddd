#include "tests/layer/scheduler.h"

#include <algorithm>

namespace rgc_layer {

Scheduler::Scheduler(Forward forward, std::optional<uint64_t> seed) : forward_(std::move(forward)) {
  if (seed) random_.emplace(*seed);
}

void Scheduler::add_semaphore(VkSemaphore semaphore, bool timeline, uint64_t value) {
  const std::lock_guard lock(mutex_);
  semaphores_[semaphore] = {timeline, value};
}

void Scheduler::remove_semaphore(VkSemaphore semaphore) {
  const std::lock_guard lock(mutex_);
  semaphores_.erase(semaphore);
}

void Scheduler::signal_from_host(VkSemaphore semaphore, uint64_t value) {
  const std::lock_guard lock(mutex_);
  Semaphore& row = semaphores_[semaphore];
  row.value = std::max(row.value, value);
  if (!random_ || host_waits_ > 0) forward_ready();
}

// A binary semaphore is covered when no earlier submission that signals it is still held; one from outside (a swapchain image) always is.
bool Scheduler::covered(const VkSemaphoreSubmitInfo& wait, const Submission& waiter) const {
  const auto semaphore = semaphores_.find(wait.semaphore);
  if (semaphore == semaphores_.end()) return true;
  if (semaphore->second.timeline) return wait.value <= semaphore->second.value;
  for (const std::deque<Submission>& queue : held_)
    for (const Submission& other : queue)
      for (const VkSemaphoreSubmitInfo& signal : other.signals)
        if (signal.semaphore == wait.semaphore && other.number < waiter.number) return false;
  return true;
}

bool Scheduler::may_go(const Submission& submission) const {
  return std::all_of(submission.waits.begin(), submission.waits.end(), [&](const VkSemaphoreSubmitInfo& wait) { return covered(wait, submission); });
}

uint32_t Scheduler::choose(const std::vector<uint32_t>& ready) {
  if (random_) return ready[(*random_)() % ready.size()];
  return *std::min_element(ready.begin(), ready.end(), [&](uint32_t a, uint32_t b) { return held_[a].front().number < held_[b].front().number; });
}

VkResult Scheduler::forward_head(uint32_t queue) {
  const Submission submission = std::move(held_[queue].front());
  held_[queue].pop_front();
  const VkResult result = forward_(submission);
  for (const VkSemaphoreSubmitInfo& signal : submission.signals) {
    const auto semaphore = semaphores_.find(signal.semaphore);
    if (semaphore != semaphores_.end()) semaphore->second.value = std::max(semaphore->second.value, signal.value);
  }
  return result;
}

VkResult Scheduler::forward_ready() {
  VkResult result = VK_SUCCESS;
  for (;;) {
    std::vector<uint32_t> ready;
    for (uint32_t queue = 0; queue < kQueues; ++queue)
      if (!held_[queue].empty() && may_go(held_[queue].front())) ready.push_back(queue);
    if (ready.empty()) break;
    const VkResult forwarded = forward_head(choose(ready));
    if (forwarded != VK_SUCCESS) result = forwarded;
  }
  progress_.notify_all();
  return result;
}

bool Scheduler::empty() const {
  return std::all_of(held_.begin(), held_.end(), [](const auto& queue) { return queue.empty(); });
}

VkResult Scheduler::submit(uint32_t queue, std::vector<Submission> submissions) {
  const std::lock_guard lock(mutex_);
  for (Submission& submission : submissions) {
    submission.number = ++submitted_;
    held_[queue].push_back(std::move(submission));
  }
  return !random_ || host_waits_ > 0 ? forward_ready() : VK_SUCCESS;
}

VkResult Scheduler::drain(const std::function<VkResult()>& then) {
  std::unique_lock lock(mutex_);
  ++host_waits_;
  forward_ready();
  progress_.wait(lock, [this] { return empty(); });
  --host_waits_;
  return then();
}

Scheduler::HostWait::HostWait(Scheduler& scheduler) : scheduler_(scheduler) {
  const std::lock_guard lock(scheduler_.mutex_);
  ++scheduler_.host_waits_;
  scheduler_.forward_ready();
}
Scheduler::HostWait::~HostWait() {
  const std::lock_guard lock(scheduler_.mutex_);
  --scheduler_.host_waits_;
}

}  // namespace rgc_layer
