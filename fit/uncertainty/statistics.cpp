#include "fit/uncertainty/statistics.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace culet {

namespace {

// With thousands of degrees of freedom an intermediate gamma function overflows, but the tail is
// correct.
using Policy = boost::math::policies::policy<
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;

}  // namespace

double chi2_tail(double chi2, double dof) {
    if (!(dof > 0) || !(chi2 > 0)) return 1;
    if (std::isinf(chi2)) return 0;
    return boost::math::cdf(complement(ChiSquared(dof), chi2));
}

double chi2_lower_tail(double chi2, double dof) {
    if (!(dof > 0) || std::isinf(chi2)) return 1;
    return boost::math::cdf(ChiSquared(dof), std::max(0.0, chi2));
}

double student_tail(double t, double dof) {
    if (!std::isfinite(t)) return 0;
    return 2 * boost::math::cdf(complement(boost::math::students_t(dof), std::abs(t)));
}

double chi2_quantile(double level, double dof) {
    if (!(dof > 0)) return 0;
    return boost::math::quantile(complement(ChiSquared(dof), level));
}

double two_sided_normal_quantile(double level) {
    return boost::math::quantile(complement(boost::math::normal(), 0.5 * level));
}

}  // namespace culet
