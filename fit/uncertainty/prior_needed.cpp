#include "fit/uncertainty/prior_needed.h"

#include <algorithm>

#include "fit/model/system.h"
#include "fit/solve/relaxation.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options) {
    options.prior.source = Prior::Source::none;
    for (const Reading& r : readings) {
        if (r.told) return true;
    }
    const System system(stone, readings, options);
    // Symmetry within a sigma makes more equations than it tells anything.
    const auto values = std::count_if(readings.begin(), readings.end(), [](const Reading& r) {
        return !is_relation(r.kind) && !r.exact;
    });
    const Parameters parameters = system.parameters();
    const Relaxation::Counts counts = Relaxation(system, parameters).counts();
    // A polyhedron of E edges has E + 6 freedoms, four of which move it as a whole. Soft meets hold
    // nearly as well as exact ones, which the count of hard equations does not see.
    constexpr int k_shifts = 3, k_shape = 2;
    const int free = std::min(parameters.size() - counts.hard - k_shifts,
                              int(system.edges().edges.size()) + k_shape);
    // Who read three quarters of it did not read for an evening only: the fit may do without.
    constexpr double k_most = 0.75;
    if (double(values) >= k_most * free) return true;
    constexpr std::size_t k_large = 150;  // facets; there one would wait for it
    if (stone.solid.facets.size() > k_large) return false;
    const Covariance covariance(linearise(system, system.mesh_shape(), system.mesh_outline()));
    constexpr int k_few = 4;
    return covariance.usable() && covariance.rank_defect() <= k_few;
}

}  // namespace culet
