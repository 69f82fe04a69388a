#include "fit/uncertainty/statistics.h"

#include <cmath>
#include <numbers>

namespace culet {

double chi2_tail(double chi2, double dof) {
    if (!(dof > 0)) return 1;
    if (!(chi2 > 0)) return 1;
    if (std::isinf(chi2)) return 0;
    const double a = 0.5 * dof, x = 0.5 * chi2;
    const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        // P(a, x) = front * sum x^n / (a (a+1) ... (a+n))
        double term = 1 / a, sum = term;
        for (int n = 1; n < 100000 && term > 1e-17 * sum; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return 1 - front * sum;
    }
    // Q(a, x) = front / (x+1-a - 1(1-a)/(x+3-a - ...)), by Lentz's method.
    const double tiny = 1e-300;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
    for (int n = 1; n < 100000; ++n) {
        const double an = -n * (n - a);
        b += 2;
        d = an * d + b;
        if (std::abs(d) < tiny) d = tiny;
        c = b + an / c;
        if (std::abs(c) < tiny) c = tiny;
        d = 1 / d;
        h *= d * c;
        // Not less than the last digit, or it may never be met.
        if (std::abs(d * c - 1) < 4e-16) break;
    }
    return front * h;
}

namespace {

// Bisection: the tails are monotonic, and a few dozen halvings cost nothing.
template <typename Tail>
double where(Tail tail, double level, double high) {
    while (tail(high) > level && high < 1e12) high *= 2;
    double low = 0;
    for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (tail(middle) > level ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

double chi2_quantile(double level, double dof) {
    if (!(dof > 0)) return 0;
    return where([&](double x) { return chi2_tail(x, dof); }, level, dof + 1);
}

double two_sided_normal_quantile(double level) {
    return where([](double z) { return std::erfc(z / std::numbers::sqrt2); }, level, 1);
}

}  // namespace culet
