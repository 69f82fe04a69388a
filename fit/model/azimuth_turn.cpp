#include "fit/model/azimuth_turn.h"

#include <cmath>

namespace culet {

double azimuth_turn(const std::vector<Reading>& readings,
                    const std::function<Vec3(int facet)>& normal_of) {
    double east = 0, north = 0;
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::azimuth || r.datum.kind == Datum::Kind::facet) continue;
        const Vec3 n = normal_of(r.facets[0]);
        const double difference = r.value - std::atan2(n.y, n.x);
        east += std::cos(difference);
        north += std::sin(difference);
    }
    return east == 0 && north == 0 ? 0 : std::atan2(north, east);
}

}  // namespace culet
