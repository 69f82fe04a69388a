// Which readings of one quantity share an equation.

#include <algorithm>
#include <cmath>

#include "fit/model/constants.h"
#include "fit/model/inclination_side.h"
#include "fit/model/system.h"

namespace culet {

bool System::may_be_merged(const std::vector<int>& group, const Replicates& replicates,
                           const Shape& shape) const {
    const Reading& first = readings_[std::size_t(group.front())];
    if (first.kind == ReadingKind::azimuth) {
        const int datum = first.datum.kind == Datum::Kind::facet ? first.datum.facet : -1;
        const double error = azimuth_error(first.facets[0], datum, replicates.value)(shape).value;
        return std::all_of(replicates.all.begin(), replicates.all.end(), [&](const Replicate& r) {
            return std::abs(error - r.off) < k_shapes.farthest_azimuth;
        });
    }
    if (first.kind != ReadingKind::inclination || first.datum.kind != Datum::Kind::up) return true;
    return std::all_of(group.begin(), group.end(), [&](int r) {
        return std::all_of(first.facets.begin(), first.facets.end(), [&](int f) {
            const Vec3& n = shape.normals[std::size_t(f)];
            return side_of(n, readings_[std::size_t(r)].value) == side_of(n, replicates.value);
        });
    });
}

System::MergedReadings System::merged_readings(const Shape& shape) const {
    MergedReadings result;
    result.replicates.resize(readings_.size());
    result.is_merged.resize(readings_.size(), false);
    for (const std::vector<int>& group : replicated_) {
        const std::size_t first = std::size_t(group.front());
        Replicates own = merged(readings_, group, unit_of(readings_[first]));
        if (!may_be_merged(group, own, shape)) continue;
        result.replicates[first] = std::move(own);
        for (std::size_t k = 1; k < group.size(); ++k) {
            result.is_merged[std::size_t(group[k])] = true;
        }
    }
    return result;
}

}  // namespace culet
