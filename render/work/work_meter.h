#pragma once
// Counts a picture's work at the prices of price.h. Because work is not timed, exceeding the budget
// depends on the picture alone.

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include "stone/progress/progress.h"

namespace culet {

/// Thrown when drawing exceeds its meter's limit; caught where the limit was set.
class OverBudget : public std::exception {
public:
    const char* what() const noexcept override { return "the work allowed is done"; }
};

/// Counts in whole nanoseconds, so that the sum does not depend on the order of threads.
class WorkMeter {
public:
    /// Thread-safe.
    void spend(double ns) { spent_ += static_cast<long long>(ns); }
    /// Whether the total exceeds the limit. Deterministic: spending only grows, so a piece of work
    /// that sees this early would exceed the limit when finished, too.
    bool over() const { return spent_ > limit_; }
    void require_not_over() const {
        if (over()) throw OverBudget();
    }
    long long spent() const { return spent_; }
    /// Sets the expected total, for progress reports.
    void expect(double ns) { expected_ = static_cast<long long>(ns); }
    /// Sets the expected rest. Ignored if there is a limit: that is the total then.
    void expect_more(double ns) {
        if (!limited()) expect(static_cast<double>(spent_) + ns);
    }
    /// Done over expected work, at most 0.99; 0 if unknown.
    double fraction() const {
        const double expected = static_cast<double>(expected_);
        const double done = static_cast<double>(spent_);
        return expected > 0 ? std::min(0.99, done / expected) : 0;
    }
    void allow(double ns) { limit_ = static_cast<long long>(ns); }
    /// Counts the whole limit as spent. Call after abandoning work: how far it got depends on
    /// thread timing.
    void use_up() { spent_ = limit_; }
    double left() const { return static_cast<double>(limit_ - spent_); }
    bool limited() const { return limit_ != std::numeric_limits<long long>::max(); }

private:
    std::atomic<long long> spent_{0}, expected_{0};
    long long limit_ = std::numeric_limits<long long>::max();
};

/// Wraps `progress` to report the meter's fraction instead of the caller's. `progress` must outlive
/// it.
inline Progress counted_by(const Progress& progress, std::shared_ptr<const WorkMeter> meter) {
    if (!progress) return progress;
    return [&progress, meter = std::move(meter)](double) { return progress(meter->fraction()); };
}

}  // namespace culet
