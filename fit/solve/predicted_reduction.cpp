#include "fit/solve/predicted_reduction.h"

namespace culet {

double predicted_merit(const StepLinearisation& linearisation, const KktSolver::Solution& step,
                       const std::vector<SymmetricEntry>& bends) {
    const Eigen::VectorXd &x = step.unknowns, &stiffness = linearisation.prior_stiffness;
    // Forces are what is left of residuals, over their variances.
    double sum = linearisation.prior + 2 * linearisation.prior_gradient.dot(x) +
                 x.dot(stiffness.cwiseProduct(x));
    for (int i = 0; i < linearisation.rows.count(); ++i) {
        sum += linearisation.rows.variance[i] * step.forces(i) * step.forces(i);
    }
    for (const SymmetricEntry& e : bends) {
        sum += (e.row == e.column ? 1 : 2) * e.value * x(e.row) * x(e.column);
    }
    return sum;
}

}  // namespace culet
