#include "fit/prior_needed.h"

#include <algorithm>

#include "fit/covariance.h"
#include "fit/relaxation.h"
#include "fit/system.h"

namespace culet {

bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options) {
    options.prior.source = Prior::Source::none;
    const System system(stone, readings, options);
    // Symmetry within a sigma makes more equations than it tells anything.
    const auto values = std::count_if(readings.begin(), readings.end(), [](const Reading& r) {
        return !is_relation(r.kind) && !r.exact;
    });
    const Freedoms freedoms = system.freedoms();
    const Relaxation::Counts counts = Relaxation(system, freedoms).counts();
    constexpr int k_shifts = 3;
    if (values >= freedoms.size() - counts.hard - k_shifts) return true;
    constexpr std::size_t k_large = 150;  // facets; there one would wait for it
    if (stone.solid.facets.size() > k_large) return false;
    const Covariance covariance(
        linearise(system, system.mesh_shape(), system.mesh_outline(), false));
    constexpr int k_few = 4;
    return covariance.usable() && covariance.open_freedoms() <= k_few;
}

}  // namespace culet
