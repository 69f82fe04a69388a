#include "fit/readings/replicates.h"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace culet {

namespace {

auto quantity_of(const Reading& r) {
    std::vector<std::tuple<Place::Kind, int, int, int>> places;
    for (const Place& p : r.places) {
        places.emplace_back(p.kind, p.facet, p.other_facet, p.vertex);
    }
    const bool is_level = r.kind == ReadingKind::inclination && r.value == 0;
    return std::make_tuple(r.kind, r.aggregate, r.facets, places, r.has_direction, r.direction.x,
                           r.direction.y, r.direction.z,
                           r.kind == ReadingKind::azimuth ? 0 : r.azimuth, r.datum.kind,
                           r.datum.facet, r.side, is_level);
}

}  // namespace

std::vector<std::vector<int>> repeated_readings(const std::vector<Reading>& readings) {
    std::map<decltype(quantity_of(readings[0])), std::size_t> known;
    std::vector<std::vector<int>> groups;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (reading.exact || is_relation(reading.kind) || !(reading.sigma > 0)) continue;
        const auto [group, is_new] = known.try_emplace(quantity_of(reading), groups.size());
        if (is_new) groups.emplace_back();
        groups[group->second].push_back(static_cast<int>(r));
    }
    std::erase_if(groups, [](const std::vector<int>& group) { return group.size() < 2; });
    return groups;
}

Replicates merged(const std::vector<Reading>& readings, const std::vector<int>& group,
                  double unit) {
    Replicates result;
    const Reading& first = readings[std::size_t(group.front())];
    double weights = 0, mean = 0;
    for (const int r : group) {
        const Reading& reading = readings[std::size_t(r)];
        double off = reading.value - first.value;
        if (reading.kind == ReadingKind::azimuth) off = std::remainder(off, 2 * std::numbers::pi);
        const double sigma = reading.sigma / unit;
        result.all.push_back({r, off / unit, sigma});
        weights += 1 / (sigma * sigma);
        mean += off / unit / (sigma * sigma);
    }
    mean /= weights;
    result.value = first.value / unit + mean;
    result.sigma = 1 / std::sqrt(weights);
    for (Replicate& repeat : result.all) {
        repeat.off -= mean;
        result.scatter += repeat.off * repeat.off / (repeat.sigma * repeat.sigma);
    }
    return result;
}

}  // namespace culet
