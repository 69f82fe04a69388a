#include "fit/model/azimuth_turn.h"
#include "fit/model/constants.h"

#include <algorithm>
#include <cmath>

namespace culet {

double azimuth_turn(const std::vector<Reading>& readings,
                    const std::function<Vec3(int facet)>& normal_of, bool counted_from_mesh) {
    double east = 0, north = 0, doubled_east = 0, doubled_north = 0;
    int count = 0;
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::azimuth || r.datum.kind == Datum::Kind::facet) continue;
        const Vec3 n = normal_of(r.facets[0]);
        const double difference = r.value - std::atan2(n.y, n.x);
        east += std::cos(difference);
        north += std::sin(difference);
        doubled_east += std::cos(2 * difference);
        doubled_north += std::sin(2 * difference);
        ++count;
    }
    if (east == 0 && north == 0) return 0;
    const double turn = std::atan2(north, east);
    if (!counted_from_mesh) return turn;
    const double length = std::hypot(east, north);
    const double along = doubled_east * std::cos(2 * turn) + doubled_north * std::sin(2 * turn);
    const double sigma = std::sqrt(std::max(0.0, (count - along) / 2)) / length;
    return count >= k_frame.least_differences && std::abs(turn) > k_frame.sure_turn * sigma ? turn
                                                                                            : 0;
}

}  // namespace culet
