#include "fit/readings/level_facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_level_sigmas = 3;
// Facets that lean more are not level, however uncertain the reading.
constexpr double k_level_deg = 5;

bool is_plain(const Reading& r, ReadingKind kind) {
    return r.kind == kind && r.aggregate == Aggregate::single && r.facets.size() == 1;
}

bool counts_from_up(const Reading& r, int up_facet) {
    return r.datum.kind == Datum::Kind::up ||
           (r.datum.kind == Datum::Kind::facet && r.datum.facet == up_facet);
}

}  // namespace

void refuse_level_azimuths(const std::vector<Reading>& readings, const Stone& stone) {
    const int up_facet = find_facet(stone.solid, stone.up_facet);
    std::map<int, const Reading*> level;  // and the reading that makes it level
    for (const Reading& r : readings) {
        if (!r.exact) continue;
        if (is_plain(r, ReadingKind::inclination) && r.value == 0 && counts_from_up(r, up_facet)) {
            level.emplace(r.facets[0], &r);
        }
        if ((r.kind == ReadingKind::parallel || r.kind == ReadingKind::coplanar) &&
            std::find(r.facets.begin(), r.facets.end(), up_facet) != r.facets.end()) {
            for (const int f : r.facets) level.emplace(f, &r);
        }
    }
    for (const Reading& r : readings) {
        if (!is_plain(r, ReadingKind::azimuth)) continue;
        for (const int f : {r.facets[0], r.datum.kind == Datum::Kind::facet ? r.datum.facet : -1}) {
            const auto found = level.find(f);
            if (f < 0 || found == level.end()) continue;
            throw InputError(
                r.file, r.line,
                fmt::format("azimuth '{}': facet '{}' lies level ({} '{}' is exact), and a level "
                            "facet has no azimuth; leave this reading out",
                            r.id, stone.solid.facets[std::size_t(f)].name,
                            name_of(found->second->kind), found->second->id));
        }
    }
}

std::vector<std::size_t> meaningless_azimuths(const std::vector<Reading>& readings) {
    std::map<int, bool> level;
    for (const Reading& r : readings) {
        if (!is_plain(r, ReadingKind::inclination) || r.datum.kind != Datum::Kind::up) continue;
        const double sigma = std::hypot(r.sigma, r.rounding / std::sqrt(12.0));
        const bool is_level =
            !r.exact && r.value < std::min(k_level_sigmas * sigma, radians(k_level_deg));
        const auto [at, fresh] = level.emplace(r.facets[0], is_level);
        if (!fresh) at->second = at->second && is_level;
    }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& r = readings[i];
        if (!is_plain(r, ReadingKind::azimuth)) continue;
        const auto own = level.find(r.facets[0]);
        const auto datum =
            r.datum.kind == Datum::Kind::facet ? level.find(r.datum.facet) : level.end();
        if ((own != level.end() && own->second) || (datum != level.end() && datum->second)) {
            found.push_back(i);
        }
    }
    return found;
}

}  // namespace culet
