// Decides which readings of one quantity share an equation.

#include <algorithm>
#include <cmath>

#include "fit/model/constants.h"
#include "fit/model/equations.h"
#include "fit/model/inclination_side.h"

namespace culet {

namespace {

// Whether the readings have the same active branch at this shape: inclinations lean to the same
// side, azimuths differ by less than half a turn.
bool may_be_merged(const std::vector<Reading>& readings, const std::vector<int>& group,
                   const Replicates& replicates, const Shape& shape) {
    const Reading& first = readings[std::size_t(group.front())];
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
            return side_of(n, readings[std::size_t(r)].value) == side_of(n, replicates.value);
        });
    });
}

}  // namespace

MergedReadings merged_readings(const FitModel& model, const Shape& shape) {
    const std::vector<Reading>& readings = model.readings();
    MergedReadings result;
    result.replicates.resize(readings.size());
    result.is_merged.resize(readings.size(), false);
    for (const std::vector<int>& group : model.replicated()) {
        const std::size_t first = std::size_t(group.front());
        Replicates own = merged(readings, group, model.frame().unit_of(readings[first]));
        if (!may_be_merged(readings, group, own, shape)) continue;
        result.replicates[first] = std::move(own);
        for (std::size_t k = 1; k < group.size(); ++k) {
            result.is_merged[std::size_t(group[k])] = true;
        }
    }
    return result;
}

}  // namespace culet
