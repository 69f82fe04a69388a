#include "fit/uncertainty/prior_needed.h"

#include <algorithm>

#include "fit/model/fit_model.h"
#include "fit/solve/relaxation.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

bool readings_hold_all(const Stone& stone, const std::vector<Reading>& readings,
                       FitOptions options) {
    options.prior.source = Prior::Source::none;
    for (const Reading& r : readings) {
        if (r.outline_observations) return true;
    }
    const FitModel model(stone, readings, options);
    // A symmetry within a sigma makes more equations than it adds information.
    std::ptrdiff_t values = 0;
    for (const Reading& r : readings) values += r.seen_line ? 2 : r.is_measured();
    const Parameters parameters = model.parameters();
    const Relaxation::Counts counts = Relaxation(model, parameters).counts();
    const int free = std::min(counts.free, int(model.edges().edges.size()) + k_needed.shape);
    if (double(values) >= k_needed.part_read * free) return true;
    if (stone.solid.facets.size() > k_needed.many_facets) return false;
    const Covariance covariance(linearise(model, model.mesh_shape(), model.mesh_outline()));
    return covariance.usable() && covariance.rank_defect() <= k_needed.few_open;
}

}  // namespace culet
