#include "fit/solve/second_order_correction.h"
#include "fit/solve/constants.h"

#include <algorithm>
#include <limits>

namespace culet {

Corrected onto_hard_equations(const Relaxation& relaxation, const KktSolver& solver,
                              const StepLinearisation& linearisation, const PenaltyScale& penalty,
                              Shape shape, const Correction& correction) {
    const Parameters& parameters = relaxation.parameters();
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(parameters.size());
    double off_before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < correction.most; ++k) {
        const Relaxation::Missed missed =
            relaxation.missed(shape, penalty, linearisation.holding, k_newton.corrected_variance);
        if (missed.worst < correction.met) break;
        if (!(missed.worst < 0.5 * off_before)) return {std::move(shape), true};
        off_before = missed.worst;
        // Hinges, whose rows come last, are not corrected.
        Eigen::VectorXd back = Eigen::VectorXd::Zero(linearisation.rows.count());
        const Eigen::Index common = std::min(back.size(), missed.residuals.size());
        back.head(common) = -missed.residuals.head(common);
        const auto s = solver.solve(none, back, correction.precision);
        if (!s.good) break;
        shape = parameters.retracted(
            shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())});
    }
    return {std::move(shape), false};
}

}  // namespace culet
