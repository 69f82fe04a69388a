#include "fit/model/datum_defect.h"
#include "fit/model/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace culet {

Eigen::MatrixXd datum_defect(const Linearised& linear) {
    Eigen::MatrixXd motions(linear.layout.size(), Eigen::Index(linear.gauge_rows.size()) + 1);
    Eigen::Index count = 0;
    std::vector<Eigen::VectorXd> all;
    for (const Eigen::VectorXd& row : linear.gauge_rows) {
        all.push_back(row.cwiseQuotient(linear.metric));
    }
    if (linear.turn.size() > 0) {
        const double size = linear.turn.dot(linear.metric.cwiseProduct(linear.turn));
        const double hard = (linear.hard_rows * linear.turn).norm();
        if ((linear.soft_rows * linear.turn).squaredNorm() < k_shapes.determined * size &&
            hard < 1e-9 * linear.turn.norm()) {
            all.push_back(linear.turn);
        }
    }
    for (Eigen::VectorXd& g : all) {
        g /= g.norm();
        for (int twice = 0; twice < 2; ++twice) {
            for (Eigen::Index k = 0; k < count; ++k) {
                g -= motions.col(k) * motions.col(k).dot(linear.metric.cwiseProduct(g));
            }
        }
        const double size = std::sqrt(g.dot(linear.metric.cwiseProduct(g)));
        if (!(size > 1e-6)) continue;
        motions.col(count++) = g / size;
    }
    return motions.leftCols(count);
}

Eigen::Index count_unobservable(const Eigen::MatrixXd& directions,
                                const Eigen::VectorXd& information, const Eigen::VectorXd& metric) {
    // Remaining variance of each unknown, relative to the mesh's.
    Eigen::VectorXd left = Eigen::VectorXd::Zero(metric.size());
    Eigen::Index open = directions.cols();
    for (; open > 0; --open) {
        left += directions.col(open - 1).cwiseAbs2().cwiseProduct(metric) /
                std::max(information(open - 1), std::numeric_limits<double>::min());
        if (!(left.maxCoeff() < 1 / k_shapes.determined)) break;
    }
    return open;
}

}  // namespace culet
