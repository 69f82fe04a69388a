// The last stage's economy: what a step promises, and ends that were found before.

#include <gtest/gtest.h>

#include <cmath>

#include "fit/measurement.h"
#include "fit/promised_merit.h"
#include "tests/bench/fit_trials.h"

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
double left_by(const Sheet& sheet, const Eigen::VectorXd& step) {
    double sum = sheet.prior + 2 * sheet.prior_gradient.dot(step) +
                 step.cwiseAbs2().dot(sheet.prior_stiffness);
    for (int i = 0; i < sheet.rows.count(); ++i) {
        double left = sheet.rows.residual[std::size_t(i)];
        for (int k = sheet.rows.begin[std::size_t(i)]; k < sheet.rows.begin[std::size_t(i) + 1];
             ++k) {
            left += sheet.rows.slope[std::size_t(k)] * step(sheet.rows.column[std::size_t(k)]);
        }
        sum += left * left / sheet.rows.variance[std::size_t(i)];
    }
    return sum;
}

TEST_F(Settling, AStepPromisesWhatItsEquationsLeave) {
    const Freedoms freedoms = system_.freedoms();
    Relaxation relaxation(system_, freedoms);
    Softness softness;
    softness.incidence = softness.readings = 0.01;
    softness.hinge = 0.002;
    Shape shape = system_.mesh_shape();
    KktSolver solver;
    double kept = 1;
    for (int i = 0; i < 8; ++i) {
        const Sheet sheet = relaxation.sheet(shape, softness);
        ASSERT_TRUE(solver.factor(sheet.rows, sheet.prior_stiffness + 1e-6 * relaxation.metric()));
        const auto s = solver.solve(-sheet.prior_gradient, -sheet.rows.residuals());
        ASSERT_TRUE(s.good);
        const double promised = promised_merit(sheet, s);
        EXPECT_NEAR(promised, left_by(sheet, s.unknowns), 1e-9 * (1 + sheet.merit));
        shape =
            freedoms.moved(shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())});
        kept = std::abs(relaxation.sheet(shape, softness).merit - promised);
    }
    // Where steps have become short the equations are straight.
    EXPECT_LT(kept, 1e-9);
}

}  // namespace
}  // namespace culet
