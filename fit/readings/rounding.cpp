#include "fit/readings/rounding.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace culet {

double common_rounding_variance(double sigma, double step) {
    if (!(step > 0)) return 0;
    const double pi2 = std::numbers::pi * std::numbers::pi;
    const double x = 4 * pi2 * (sigma / step) * (sigma / step);
    // The sum of 1/k^2 converges slowly: use its limit, less what the exponentials remove.
    if (x < 1e-6) {
        return std::max(0.0, step * step / 12 - sigma * step / std::sqrt(std::numbers::pi));
    }
    double sum = 0;
    for (int k = 1; k < 100000; ++k) {
        const double term = std::exp(-x * k * k) / (double(k) * k);
        sum += term;
        if (term < 1e-17 * sum || !(term > 0)) break;
    }
    return step * step / (2 * pi2) * sum;
}

double rounded_sigma(double sigma, double step, int replicates) {
    const double common = common_rounding_variance(sigma, step);
    return std::sqrt(sigma * sigma + step * step / 12 + (replicates - 1) * common);
}

namespace {

// For each facet, the first of those that exact symmetry makes alike.
std::vector<int> orbits(const std::vector<std::pair<int, int>>& alike, int facets) {
    std::vector<int> root(static_cast<std::size_t>(facets));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int f) {
        while (root[std::size_t(f)] != f) f = root[std::size_t(f)];
        return f;
    };
    for (const auto& [a, b] : alike) {
        const int ra = find(a), rb = find(b);
        root[std::size_t(std::max(ra, rb))] = std::min(ra, rb);
    }
    for (int f = 0; f < facets; ++f) root[std::size_t(f)] = find(f);
    return root;
}

}  // namespace

void widen_for_rounding(std::vector<Reading>& readings,
                        const std::vector<std::pair<int, int>>& alike, int facets) {
    const std::vector<int> orbit = orbits(alike, facets);
    using Key = std::tuple<ReadingKind, Aggregate, Datum::Kind, int, double, double, double,
                           std::vector<int>, std::vector<std::string>>;
    std::map<Key, std::vector<std::size_t>> groups;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (!(reading.rounding > 0) || reading.exact || is_relation(reading.kind)) continue;
        const bool by_orbit = reading.kind == ReadingKind::inclination ||
                              reading.kind == ReadingKind::dihedral ||
                              reading.kind == ReadingKind::edge;
        std::vector<int> who;
        for (const int f : reading.facets) who.push_back(by_orbit ? orbit[std::size_t(f)] : f);
        if (by_orbit) std::sort(who.begin(), who.end());
        groups[{reading.kind, reading.aggregate, reading.datum.kind,
                reading.datum.facet < 0 ? -1 : orbit[std::size_t(reading.datum.facet)],
                reading.value, reading.sigma, reading.rounding, who,
                reading.facets.empty() ? reading.of : std::vector<std::string>()}]
            .push_back(r);
    }
    for (const auto& [key, group] : groups) {
        for (const std::size_t r : group) {
            readings[r].sigma =
                rounded_sigma(readings[r].sigma, readings[r].rounding, int(group.size()));
        }
    }
}

}  // namespace culet
