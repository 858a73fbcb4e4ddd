// Several queues over one that runs in order. A submission is held in the queue it was made on until everything it waits for has gone to the real
// queue; so the real queue never waits for something behind it, whatever order the program submits in.
//
//   eager    what may go goes at once, oldest first
//   seeded   everything is held until the host waits for something; then the heads of the queues go in a legal order drawn from the seed
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <random>
#include <unordered_map>
#include <vector>

namespace rgc_layer {

inline constexpr uint32_t kQueues = 3;  // one a family: universal, compute, transfer

struct Submission {
  uint64_t number = 0;  // over all queues, in the order of the calls
  std::vector<VkSemaphoreSubmitInfo> waits, signals;
  std::vector<VkCommandBufferSubmitInfo> commands;
  VkSubmitFlags flags = 0;
  VkFence fence = VK_NULL_HANDLE;
};

class Scheduler {
 public:
  using Forward = std::function<VkResult(const Submission&)>;  // to the real queue
  Scheduler(Forward forward, std::optional<uint64_t> seed);

  void add_semaphore(VkSemaphore semaphore, bool timeline, uint64_t value);
  void remove_semaphore(VkSemaphore semaphore);
  void signal_from_host(VkSemaphore semaphore, uint64_t value);

  VkResult submit(uint32_t queue, std::vector<Submission> submissions);
  // Returns when nothing is held on any queue; `then` runs before anybody else may submit.
  VkResult drain(const std::function<VkResult()>& then);

  // While one lives, nothing that may go is held: somebody on the host waits for it.
  class HostWait {
   public:
    explicit HostWait(Scheduler& scheduler);
    ~HostWait();

   private:
    Scheduler& scheduler_;
  };

 private:
  struct Semaphore {
    bool timeline = false;
    uint64_t value = 0;  // timelines: the largest that was forwarded or signalled by the host
  };
  bool covered(const VkSemaphoreSubmitInfo& wait, const Submission& waiter) const;
  bool may_go(const Submission& submission) const;
  uint32_t choose(const std::vector<uint32_t>& ready);
  VkResult forward_head(uint32_t queue);
  VkResult forward_ready();  // all of it, mutex held
  bool empty() const;

  Forward forward_;
  std::optional<std::mt19937_64> random_;
  std::mutex mutex_;
  std::condition_variable progress_;
  std::array<std::deque<Submission>, kQueues> held_;
  std::unordered_map<VkSemaphore, Semaphore> semaphores_;
  uint64_t submitted_ = 0;
  int host_waits_ = 0;
};

}  // namespace rgc_layer
