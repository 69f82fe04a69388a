#pragma once
// Lets many drawing threads ask one Progress whether to go on.

#include <atomic>
#include <chrono>
#include <mutex>

#include "stone/progress/progress.h"

namespace culet {

class Listener {
public:
    /// `progress` must outlive it. `parts`: number of parts of the work, for the reported fraction;
    /// 0: always reports 0.
    explicit Listener(const Progress& progress, double parts = 0)
        : progress_(progress), parts_(parts) {}

    /// Call before each part, from any thread. After a stop Progress is not asked again, not even
    /// by waiting threads.
    bool goes_on() {
        if (!progress_) return true;
        if (stopped()) return false;
        const std::lock_guard<std::mutex> lock(mutex_);
        if (stopped()) return false;
        const double done = done_++;
        if (!progress_(parts_ > 0 ? done / parts_ : 0)) stop_ = true;
        return !stopped();
    }
    /// Call within a long part, as often as every few microseconds: Progress is asked about fifty
    /// times a second.
    bool still_goes_on() {
        if (!progress_) return true;
        if (stopped()) return false;
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        if (now < std::chrono::nanoseconds(next_)) return true;
        const std::lock_guard<std::mutex> lock(mutex_);
        next_ = std::chrono::nanoseconds(now + std::chrono::milliseconds(20)).count();
        if (!stopped() && !progress_(parts_ > 0 ? done_ / parts_ : 0)) stop_ = true;
        return !stopped();
    }
    bool stopped() const { return stop_; }

private:
    const Progress& progress_;
    double parts_, done_ = 0;
    std::mutex mutex_;
    std::atomic<bool> stop_{false};
    std::atomic<long long> next_{0};  // time of the next question, ns of the steady clock
};

}  // namespace culet
