#include "stone/design/proportions.h"

#include <algorithm>
#include <cmath>

#include "stone/numbers/units.h"
#include "stone/solid/angles.h"

namespace culet {

namespace {

struct Range {
    double low = INFINITY, high = -INFINITY;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double extent() const { return high > low ? high - low : 0; }
};

Range range_of(const Solid& solid, const Facet& facet, int axis) {
    Range range;
    for (const int corner : facet.corners) range.add(solid.vertices[corner][axis]);
    return range;
}

}  // namespace

Proportions proportions(const Solid& solid) {
    const double girdle_from = radians(89), table_up_to = radians(5);
    Range extent[3];
    for (const Vec3& v : solid.vertices) {
        for (int axis = 0; axis < 3; ++axis) extent[axis].add(v[axis]);
    }
    Proportions result;
    const int along_width = extent[0].extent() <= extent[1].extent() ? 0 : 1;
    result.width = extent[along_width].extent();
    result.length = extent[1 - along_width].extent();
    result.height = extent[2].extent();

    const Facet* table = nullptr;
    double table_area = 0;
    for (const Facet& facet : solid.facets) {
        const double tilt = inclination(facet.plane.normal, {0, 0, 1});
        if (tilt >= girdle_from) continue;
        const Range z = range_of(solid, facet, 2);
        if (facet.plane.normal.z < 0) {
            result.pavilion = std::max(result.pavilion, z.high - extent[2].low);
            continue;
        }
        result.crown = std::max(result.crown, extent[2].high - z.low);
        const double size = area(solid, facet);
        if (tilt <= table_up_to && size > table_area &&
            z.high > extent[2].high - 1e-3 * result.height) {
            table = &facet;
            table_area = size;
        }
    }
    if (table != nullptr) {
        result.table_width = range_of(solid, *table, along_width).extent();
        result.table_length = range_of(solid, *table, 1 - along_width).extent();
    }
    return result;
}

}  // namespace culet
