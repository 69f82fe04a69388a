#pragma once
// How much work a picture has taken, counted (price.h) and not timed: where it runs over what
// is allowed depends on the picture alone, whatever else the machine does.

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include "stone/progress/progress.h"

namespace culet {

/// Thrown by drawing that runs over its meter's limit; caught where that was set.
class OverBudget : public std::exception {
public:
    const char* what() const noexcept override { return "the work allowed is done"; }
};

/// Whole nanoseconds of price.h, so that their sum does not hang on the order of threads.
class WorkMeter {
public:
    /// From any thread.
    void spend(double ns) { spent_ += static_cast<long long>(ns); }
    /// No more of a piece of work is of use: together it is more than is allowed. Where one thread
    /// sees this before a piece is done, the others would have brought it there.
    bool over() const { return spent_ > limit_; }
    void require_not_over() const {
        if (over()) throw OverBudget();
    }
    long long spent() const { return spent_; }
    /// All of it, as far as is known: for who waits.
    void expect(double ns) { expected_ = static_cast<long long>(ns); }
    /// The same of what is still to be done; where there is a limit, that is all.
    void expect_more(double ns) {
        if (!limited()) expect(static_cast<double>(spent_) + ns);
    }
    /// Of all of it, what is done; 0: nobody knows.
    double fraction() const {
        const double expected = static_cast<double>(expected_);
        const double done = static_cast<double>(spent_);
        return expected > 0 ? std::min(0.99, done / expected) : 0;
    }
    void allow(double ns) { limit_ = static_cast<long long>(ns); }
    /// After a piece of work that was let go: what it had come to hangs on chance, so that all that
    /// was allowed counts as spent.
    void use_up() { spent_ = limit_; }
    double left() const { return static_cast<double>(limit_ - spent_); }
    bool limited() const { return limit_ != std::numeric_limits<long long>::max(); }

private:
    std::atomic<long long> spent_{0}, expected_{0};
    long long limit_ = std::numeric_limits<long long>::max();
};

/// `progress`, told how much of the expected work is done, whatever piece of it asks; it must
/// outlive what is returned.
inline Progress counted_by(const Progress& progress, std::shared_ptr<const WorkMeter> meter) {
    if (!progress) return progress;
    return [&progress, meter = std::move(meter)](double) { return progress(meter->fraction()); };
}

}  // namespace culet
