// The last stage's economy: what a step promises, and ends that were found before.

#include <gtest/gtest.h>

#include <cmath>

#include "fit/readings/measurement.h"
#include "fit/solve/predicted_reduction.h"
#include "tests/fit/fit_trials.h"

namespace culet {
namespace {

using namespace bench;

class Settling : public ::testing::Test {
protected:
    const Truth truth_ = make_truth(TruthKind::step, false, 4);
    const Stone mesh_ = noisy_mesh(truth_.stone, 0.01, 9);  // the system refers to it
    const System system_{mesh_, bind_readings(read_by_instruments(truth_, 17), mesh_), {}};
};

// From the equations' residuals and slopes one by one, without the solver's forces.
double left_by(const StepLinearisation& linearisation, const Eigen::VectorXd& step) {
    double sum = linearisation.prior + 2 * linearisation.prior_gradient.dot(step) +
                 step.cwiseAbs2().dot(linearisation.prior_stiffness);
    for (int i = 0; i < linearisation.rows.count(); ++i) {
        double left = linearisation.rows.residual[std::size_t(i)];
        for (int k = linearisation.rows.begin[std::size_t(i)];
             k < linearisation.rows.begin[std::size_t(i) + 1]; ++k) {
            left += linearisation.rows.slope[std::size_t(k)] *
                    step(linearisation.rows.column[std::size_t(k)]);
        }
        sum += left * left / linearisation.rows.variance[std::size_t(i)];
    }
    return sum;
}

TEST_F(Settling, AStepPromisesWhatItsEquationsLeave) {
    const Parameters parameters = system_.parameters();
    Relaxation relaxation(system_, parameters);
    PenaltyScale penalty;
    penalty.incidence = penalty.readings = 0.01;
    penalty.hinge = 0.002;
    Shape shape = system_.mesh_shape();
    KktSolver solver;
    double kept = 1;
    for (int i = 0; i < 8; ++i) {
        const StepLinearisation linearisation = relaxation.linearisation(shape, penalty);
        ASSERT_TRUE(solver.factor(linearisation.rows,
                                  linearisation.prior_stiffness + 1e-6 * relaxation.metric()));
        const auto s = solver.solve(-linearisation.prior_gradient, -linearisation.rows.residuals());
        ASSERT_TRUE(s.good);
        const double predicted = predicted_merit(linearisation, s);
        EXPECT_NEAR(predicted, left_by(linearisation, s.unknowns),
                    1e-9 * (1 + linearisation.merit));
        shape = parameters.retracted(
            shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())});
        kept = std::abs(relaxation.linearisation(shape, penalty).merit - predicted);
    }
    // Where steps have become short the equations are straight.
    EXPECT_LT(kept, 1e-9);
}

}  // namespace
}  // namespace culet
