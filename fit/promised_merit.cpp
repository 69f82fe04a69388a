#include "fit/promised_merit.h"

namespace culet {

double promised_merit(const Sheet& sheet, const KktSolver::Solution& step,
                      const std::vector<SymmetricEntry>& bends) {
    const Eigen::VectorXd &x = step.unknowns, &stiffness = sheet.prior_stiffness;
    // Forces are what is left of residuals, over their variances.
    double sum = sheet.prior + 2 * sheet.prior_gradient.dot(x) + x.dot(stiffness.cwiseProduct(x));
    for (int i = 0; i < sheet.rows.count(); ++i) {
        sum += sheet.rows.variance[i] * step.forces(i) * step.forces(i);
    }
    for (const SymmetricEntry& e : bends) {
        sum += (e.row == e.column ? 1 : 2) * e.value * x(e.row) * x(e.column);
    }
    return sum;
}

}  // namespace culet
