// SPDX-License-Identifier: Apache-2.0
// Few jobs at a time, the others in the order in which they came.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>

namespace ifa::studio {

/// Thread safe.
class JobSlots {
 public:
  /// @param running  jobs at a time  @param waiting  that may wait beside these
  JobSlots(std::size_t running, std::size_t waiting) : running_(running), waiting_(waiting) {}

  /// The right to run; given back when it goes.
  class Turn {
   public:
    Turn() = default;
    Turn(JobSlots* slots, std::uint64_t ticket) : slots_(slots), ticket_(ticket) {}
    Turn(Turn&& other) noexcept : slots_(other.slots_), ticket_(other.ticket_) {
      other.slots_ = nullptr;
    }
    Turn& operator=(Turn&&) = delete;
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() {
      if (slots_ != nullptr) slots_->leave(ticket_);
    }
    /// False where too many wait already.
    [[nodiscard]] bool queued() const { return slots_ != nullptr; }

    /// Waits until the job may run. @param goOn  told how many are before it, several times a
    /// second; false gives up.  @return whether it may run
    [[nodiscard]] bool wait(const std::function<bool(std::size_t)>& goOn) const {
      return slots_->wait(ticket_, goOn);
    }

   private:
    JobSlots* slots_ = nullptr;
    std::uint64_t ticket_ = 0;
  };

  /// A place in the queue.
  [[nodiscard]] Turn enter() {
    const std::scoped_lock lock(mutex_);
    if (tickets_.size() >= running_ + waiting_) return {};
    tickets_.insert(next_);
    return {this, next_++};
  }

 private:
  /// Jobs that must end before this one may run.
  [[nodiscard]] std::size_t before(std::uint64_t ticket) const {
    const auto ahead =
        static_cast<std::size_t>(std::distance(tickets_.begin(), tickets_.find(ticket)));
    return ahead < running_ ? 0 : ahead - running_ + 1;
  }

  bool wait(std::uint64_t ticket, const std::function<bool(std::size_t)>& goOn) {
    std::unique_lock lock(mutex_);
    for (;;) {
      const std::size_t ahead = before(ticket);
      lock.unlock();
      if (!goOn(ahead)) return false;
      lock.lock();
      if (ahead == 0) return true;
      changed_.wait_for(lock, std::chrono::milliseconds(200));
    }
  }

  void leave(std::uint64_t ticket) {
    {
      const std::scoped_lock lock(mutex_);
      tickets_.erase(ticket);
    }
    changed_.notify_all();
  }

  std::size_t running_, waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::uint64_t> tickets_;  ///< of those that run and those that wait, oldest first
  std::uint64_t next_ = 0;
};

}  // namespace ifa::studio
