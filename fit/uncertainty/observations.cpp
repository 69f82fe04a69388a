#include "fit/uncertainty/observations.h"

#include <algorithm>

namespace culet {

double Observation::residual(const Linearised& linear) const {
    const Equation& e = linear.soft[std::size_t(equation)];
    return e.replicates.empty() ? linear.soft_residuals(equation)
                                : (linear.soft_residuals(equation) * e.sigma - off) / sigma;
}

std::vector<Observation> observations_of(const Linearised& linear) {
    std::vector<Observation> all;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        const Equation& e = linear.soft[i];
        if (!e.is_counted()) continue;
        if (e.replicates.empty()) all.push_back({Eigen::Index(i), e.reading, 0, e.sigma, 1});
        for (const Replicate& r : e.replicates) {
            all.push_back({Eigen::Index(i), r.reading, r.off, r.sigma, e.sigma / r.sigma});
        }
    }
    const auto place = [&](const Observation& o) {
        return linear.soft[std::size_t(o.equation)].incidence >= 0 ? -1 : o.reading;
    };
    std::stable_sort(all.begin(), all.end(), [&](const Observation& a, const Observation& b) {
        return place(a) < place(b);
    });
    return all;
}

}  // namespace culet
