#pragma once
// Standard deviations of tilt curves over drawn stones.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "render/grade/grade.h"

namespace culet {

// Running mean and sum of squares (Welford 1962).
struct Running {
    double mean = 0, squares = 0;
    int count = 0;
    void add(double value) {
        ++count;
        const double step = value - mean;
        mean += step / count;
        squares += step * (value - mean);
    }
    double sigma() const {
        return count >= 2 ? std::sqrt(squares / (count - 1))
                          : std::numeric_limits<double>::quiet_NaN();
    }
};

// Number of tilts at which sigma is estimated: it varies slowly along a curve.
inline constexpr std::size_t k_drawn_tilts = 7;

inline std::vector<std::size_t> drawn_tilts(std::size_t count) {
    std::vector<std::size_t> drawn;
    const std::size_t parts = std::min(count, k_drawn_tilts);
    for (std::size_t i = 0; i < parts; ++i)
        drawn.push_back(parts == 1 ? 0 : i * (count - 1) / (parts - 1));
    return drawn;
}

// Sums for every model, whole stone and table, at every drawn tilt about every axis.
class CurveSums {
public:
    CurveSums(std::size_t axes, std::size_t tilts) : sums_(axes, std::vector<Sums>(tilts)) {}

    void add(const std::vector<TiltCurve>& curves) {
        for (std::size_t a = 0; a < sums_.size(); ++a) {
            for (std::size_t i = 0; i < sums_[a].size(); ++i) {
                const ViewReturn& seen = curves[a].returns[i];
                for (std::size_t m = 0; m < seen.whole.size(); ++m) {
                    sums_[a][i].whole[m].add(seen.whole[m]);
                    sums_[a][i].table[m].add(seen.table[m]);
                }
            }
        }
    }

    // Sigmas at the drawn tilts; NaN elsewhere.
    std::vector<TiltCurve> sigmas(const GradeOptions& options,
                                  const std::vector<std::size_t>& drawn) const {
        ViewReturn unknown;
        unknown.whole.fill(std::numeric_limits<double>::quiet_NaN());
        unknown.table = unknown.whole;
        std::vector<TiltCurve> curves;
        for (std::size_t a = 0; a < sums_.size(); ++a) {
            TiltCurve curve{options.tilt_axes[a],
                            std::vector<ViewReturn>(options.tilts.size(), unknown)};
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                ViewReturn& sigma = curve.returns[drawn[i]];
                for (std::size_t m = 0; m < sigma.whole.size(); ++m) {
                    sigma.whole[m] = sums_[a][i].whole[m].sigma();
                    sigma.table[m] = sums_[a][i].table[m].sigma();
                }
            }
            curves.push_back(std::move(curve));
        }
        return curves;
    }

private:
    struct Sums {
        std::array<Running, k_light_model_count> whole, table;
    };
    std::vector<std::vector<Sums>> sums_;
};

}  // namespace culet
