#pragma once
// Weighted moments of pairs of numbers. Private to the folder.

#include <algorithm>
#include <cmath>

namespace culet {

struct WeightedPairs {
    double weight = 0;

    void add(double w, double a, double b) {
        weight += w;
        sum_a_ += w * a;
        sum_b_ += w * b;
        sum_aa_ += w * a * a;
        sum_bb_ += w * b * b;
        sum_ab_ += w * a * b;
    }
    /// 0 if one of them hardly varies. The weight must not be 0.
    double correlation() const {
        const double a = sum_aa_ - sum_a_ * sum_a_ / weight, b = sum_bb_ - sum_b_ * sum_b_ / weight;
        if (std::min(a, b) <= 1e-9 * weight) return 0;
        return (sum_ab_ - sum_a_ * sum_b_ / weight) / std::sqrt(a * b);
    }

private:
    double sum_a_ = 0, sum_b_ = 0, sum_aa_ = 0, sum_bb_ = 0, sum_ab_ = 0;
};

}  // namespace culet
