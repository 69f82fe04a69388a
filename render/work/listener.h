#pragma once
// Threads that draw ask one Progress whether to go on.

#include <atomic>
#include <chrono>
#include <mutex>

#include "stone/progress/progress.h"

namespace culet {

class Listener {
public:
    /// `progress` must outlive it; `parts`: of the work, for the fraction that is done; 0: it is
    /// not told.
    explicit Listener(const Progress& progress, double parts = 0)
        : progress_(progress), parts_(parts) {}

    /// Before each part; from any thread. Once told to stop, nobody asks again, whoever waited.
    bool goes_on() {
        if (!progress_) return true;
        if (stopped()) return false;
        const std::lock_guard<std::mutex> lock(mutex_);
        if (stopped()) return false;
        const double done = done_++;
        if (!progress_(parts_ > 0 ? done / parts_ : 0)) stop_ = true;
        return !stopped();
    }
    /// Within a part that may take long, as often as every few microseconds: Progress is asked some
    /// fifty times a second.
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
    std::atomic<long long> next_{0};  // when Progress is asked again, ns of the steady clock
};

}  // namespace culet
