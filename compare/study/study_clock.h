#pragma once
// A study's processor time: stops work that exceeds its share, or on the user's wish.

#include <algorithm>
#include <ctime>
#include <limits>

#include "stone/progress/progress.h"
#include "stone/text/errors.h"

namespace culet {

class StudyClock {
public:
    /// `seconds`: total processor time; 0: no limit.
    StudyClock(double seconds, const Progress& progress) : budget_(seconds), progress_(progress) {}

    static double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
    double spent() const { return now() - start_; }
    bool limited() const { return budget_ > 0; }
    /// This share of the budget; infinite without one.
    double share(double of_budget) const {
        return limited() ? of_budget * budget_ : std::numeric_limits<double>::infinity();
    }

    /// Runs `work(Progress)`; false: stopped after `seconds`. Throws Interrupted when the user
    /// stops it.
    template <class Work>
    bool within(double seconds, Work&& work) {
        const double end = spent() + seconds;
        try {
            work(Progress([&](double) { return goes_on() && spent() < end; }));
            return true;
        } catch (const Interrupted&) {
            if (stopped_) throw;
            return false;
        }
    }
    /// Reports progress; throws Interrupted when the user stops the work.
    void report() {
        if (!goes_on()) throw Interrupted();
    }

private:
    bool goes_on() {
        const double fraction = limited() ? std::min(1.0, spent() / budget_) : 0;
        if (progress_ && !progress_(fraction)) stopped_ = true;
        return !stopped_;
    }

    double budget_ = 0, start_ = now();
    const Progress& progress_;
    bool stopped_ = false;
};

}  // namespace culet
