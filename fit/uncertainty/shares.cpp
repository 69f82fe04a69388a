#include "fit/uncertainty/shares.h"

#include <algorithm>

#include "fit/model/facet_functions.h"

namespace culet {

namespace {

// The same equations without what was read: what the prior knows by itself, meets and symmetry
// taken for granted.
Linearised without_readings(const Linearised& linear) {
    Linearised prior = linear;
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        const Equation& e = linear.soft[i];
        if (e.role != Equation::Role::reading) kept.push_back(Eigen::Index(i));
    }
    prior.soft.clear();
    prior.soft_rows.resize(Eigen::Index(kept.size()), linear.soft_rows.cols());
    prior.soft_residuals.resize(Eigen::Index(kept.size()));
    RowWriter::Triplets entries;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        prior.soft.push_back(linear.soft[std::size_t(kept[k])]);
        prior.soft_residuals(Eigen::Index(k)) = linear.soft_residuals(kept[k]);
        using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
        for (Rows::InnerIterator it(linear.soft_rows, kept[k]); it; ++it) {
            entries.emplace_back(int(k), int(it.col()), it.value());
        }
    }
    prior.soft_rows.setFromTriplets(entries.begin(), entries.end());
    return prior;
}

}  // namespace

void find_parts_read(const Shape& shape, const Linearised& linear, const Covariance& covariance,
                     const Vec3& middle, Diagnosis& diagnosis) {
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
