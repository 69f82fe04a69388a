#include "fit/uncertainty/statistics.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace culet {

double chi2_tail(double chi2, double dof) {
    if (!(dof > 0) || !(chi2 > 0)) return 1;
    if (std::isinf(chi2)) return 0;
    return boost::math::cdf(complement(boost::math::chi_squared(dof), chi2));
}

double chi2_quantile(double level, double dof) {
    if (!(dof > 0)) return 0;
    return boost::math::quantile(complement(boost::math::chi_squared(dof), level));
}

double two_sided_normal_quantile(double level) {
    return boost::math::quantile(complement(boost::math::normal(), 0.5 * level));
}

}  // namespace culet
