#include "stone/export/export_frame.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "stone/solid/checks.h"
#include "stone/solid/plan.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Shorter edges of a grown stone are rounding errors; share of its diameter.
constexpr double k_rounding = 1e-9;

std::vector<NamedPlane> planes_of(const Solid& solid, double outward) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets)
        planes.push_back({facet.name, {facet.plane.normal, facet.plane.offset + outward}});
    return planes;
}

}  // namespace

Stone in_export_frame(const Stone& stone) {
    Stone placed = standing_upright(stone);
    const double scale = mm_per(stone.unit);
    const double girdle = girdle_outline(placed.solid).height;
    for (Vec3& v : placed.solid.vertices) v = scale * Vec3{v.x, v.y, v.z - girdle};
    for (Facet& facet : placed.solid.facets) {
        Plane& plane = facet.plane;
        plane.offset = scale * (plane.offset - plane.normal.z * girdle);
    }
    placed.unit = LengthUnit::mm;
    return placed;
}

Solid planar_solid(const Solid& solid, bool convex, double tolerance_mm) {
    if (!convex || planarity(solid) <= tolerance_mm) return solid;
    return contract_near_meets(intersect_half_spaces(planes_of(solid, 0)).solid, tolerance_mm)
        .solid;
}

Solid grown_outward(const Solid& solid, double clearance) {
    if (!(clearance > 0) || !std::isfinite(clearance))
        throw InputError(fmt::format("a clearance is a length over 0, found {:g}", clearance));
    if (!is_convex(solid))
        throw InputError("a stone that is not convex cannot be grown by a clearance");
    HalfSpaceSolid grown = intersect_half_spaces(planes_of(solid, clearance));
    if (!grown.bounded || grown.empty)
        throw InputError("the stone's planes leave it open: it cannot be grown by a clearance");
    return contract_near_meets(grown.solid, k_rounding * diameter(grown.solid)).solid;
}

}  // namespace culet
