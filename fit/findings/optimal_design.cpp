#include "fit/findings/optimal_design.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "fit/findings/candidate_readings.h"
#include "fit/model/facet_functions.h"

namespace culet {

namespace {

constexpr std::size_t k_tried = 80;  // of the most uncertain candidates, in full
constexpr std::size_t k_proposed = 5;

// 0 where readings say so little that the variance is no number: an order needs numbers.
double promise_of(const CandidateReading& c) {
    const double squares = c.function.squaredNorm();
    if (!std::isfinite(c.variance) || !(c.variance > 0) || !(squares > 0)) return 0.0;
    return c.variance * (c.variance / (c.sigma * c.sigma + c.variance)) / squares;
}

// Their places in the order of a value, the largest first. They are large, and stay where they are.
template <typename Value>
std::vector<std::size_t> by_falling(const std::vector<CandidateReading>& candidates,
                                    const Value& value) {
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return value(candidates[a]) > value(candidates[b]);
    });
    return order;
}

// Sum of squared covariances of a candidate with all parts of the total.
double drop_of(const Shape& shape, const Vec3& middle, const CandidateReading& tried,
               const Covariance& covariance) {
    const Layout layout = layout_of(shape);
    const Eigen::VectorXd with = covariance.with_all(tried.function, true);
    double drop = 0;
    for (int f = 0; f < layout.facets; ++f) {
        const auto [t, u] = tangents(shape.normals[std::size_t(f)]);
        const double a = with(layout.tilt(f)), b = with(layout.tilt(f) + 1);
        const double o = with(layout.offset(f)) - glm::dot(middle, a * t + b * u);
        drop += a * a + b * b + o * o;
    }
    return drop;
}

}  // namespace

std::vector<NextReading> next_readings(const FitModel& model, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance) {
    const Layout layout = layout_of(shape);
    const Vec3 middle = middle_of(shape);
    double total = 0;
    for (int f = 0; f < layout.facets; ++f) {
        for (int k = 0; k < 2; ++k) {
            FunctionRow row(layout.size());
            row.coeffRef(layout.tilt(f) + k) = 1;
            total += covariance.total_variance(row);
        }
        total += covariance.total_variance(facet_functions(shape, f, layout, middle)[2]);
    }
    if (!(total > 0) || !std::isfinite(total)) return {};
    std::vector<CandidateReading> all = candidate_readings(model, shape, outline);
    for (CandidateReading& c : all) {
        c.variance = covariance.total_variance(c.function);
        c.promise = promise_of(c);
    }
    // The most uncertain, but some of every kind and tier: their reach differs.
    std::vector<CandidateReading> tried;
    tried.reserve(k_tried);
    std::map<std::string, int> of_group;
    for (const std::size_t i :
         by_falling(all, [](const CandidateReading& c) { return c.promise; })) {
        if (tried.size() >= k_tried) break;
        if (++of_group[all[i].group] <= 2 && all[i].promise > 0) tried.push_back(all[i]);
    }
    for (CandidateReading& c : tried) {
        const double drop = drop_of(shape, middle, c, covariance);
        const double share = drop / (c.sigma * c.sigma + c.variance) / total;
        c.reading.reduces = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
        // Tighter than what the mesh says, where only the mesh said something.
        const double open = covariance.rank_defect() > 0 ? covariance.open_variance(c.function) : 0;
        c.reading.closes = open > 4 * c.sigma * c.sigma && open > 0.5 * c.variance;
    }
    std::vector<NextReading> best;
    std::set<std::string> told;
    for (const std::size_t i :
         by_falling(tried, [](const CandidateReading& c) { return c.reading.reduces; })) {
        const CandidateReading& c = tried[i];
        if (best.size() == k_proposed || !(c.reading.reduces > 1e-6)) break;
        if (told.insert(c.group).second) best.push_back(c.reading);
    }
    return best;
}

}  // namespace culet
