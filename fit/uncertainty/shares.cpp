#include "fit/uncertainty/shares.h"

#include <algorithm>

#include "fit/model/facet_functions.h"

namespace culet {

namespace {

Linearised without_readings(const Linearised& linear) {
    Linearised prior = linear;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        if (linear.soft[i].role != Equation::Role::reading) continue;
        prior.soft_rows.innerVector(Eigen::Index(i)) *= 0;
    }
    return prior;
}

}  // namespace

void find_parts_read(const Shape& shape, const Covariance& covariance, const Vec3& middle,
                     Diagnosis& diagnosis) {
    const Linearised& linear = covariance.linear();
    const Covariance before(without_readings(linear));
    if (!before.usable()) return;
    for (int f = 0; f < linear.layout.facets; ++f) {
        const auto rows = facet_functions(shape, f, linear.layout, middle);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double alone = before.total_variance(rows[k]);
            if (!(alone > 0)) continue;
            diagnosis.facets[std::size_t(f)].read[k] =
                std::clamp(1 - covariance.total_variance(rows[k]) / alone, 0.0, 1.0);
        }
    }
}

}  // namespace culet
