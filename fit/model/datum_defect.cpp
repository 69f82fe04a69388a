#include "fit/model/datum_defect.h"

#include <cmath>
#include <vector>

namespace culet {

Eigen::MatrixXd datum_defect(const Linearised& linear,
                             const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows) {
    Eigen::MatrixXd motions(linear.layout.size(), Eigen::Index(linear.gauge_rows.size()) + 1);
    Eigen::Index count = 0;
    std::vector<Eigen::VectorXd> all;
    for (const Eigen::VectorXd& row : linear.gauge_rows) {
        all.push_back(row.cwiseQuotient(linear.metric));
    }
    if (linear.turn.size() > 0) {
        const double size = linear.turn.dot(linear.metric.cwiseProduct(linear.turn));
        const double hard = (linear.hard_rows * linear.turn).norm();
        if ((rows * linear.turn).squaredNorm() < k_determined * size &&
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

}  // namespace culet
