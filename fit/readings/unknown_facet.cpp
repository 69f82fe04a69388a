#include "fit/readings/unknown_facet.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Facets of a hand-made mesh are rarely further off.
constexpr double k_same_deg = 8;

std::optional<double> value_of(const std::string& kind, const std::string& name,
                               const std::vector<WrittenReading>& written) {
    for (const WrittenReading& w : written) {
        if (w.kind == kind && w.of.size() == 1 && w.of[0] == name && w.value &&
            std::isfinite(*w.value) && w.datum.empty()) {
            return w.value;
        }
    }
    return std::nullopt;
}

double azimuth_in(const PlanFrame& frame, const Vec3& n) {
    return std::atan2(glm::dot(frame.y, n), glm::dot(frame.x, n));
}

// The zero of the readings' azimuths: their mean difference from the mesh's.
double azimuth_zero(const PlanFrame& frame, const std::vector<WrittenReading>& written,
                    const Stone& stone) {
    double east = 0, north = 0;
    for (const WrittenReading& w : written) {
        if (w.kind != "azimuth" || w.of.size() != 1 || !w.value || !w.datum.empty()) continue;
        const int f = find_facet(stone.solid, w.of[0]);
        if (f < 0) continue;
        const double d =
            radians(*w.value) - azimuth_in(frame, stone.solid.facets[std::size_t(f)].plane.normal);
        east += std::cos(d);
        north += std::sin(d);
    }
    return std::atan2(north, east);
}

}  // namespace

std::string where_it_may_lie(const std::string& name, const std::vector<WrittenReading>& written,
                             const Stone& stone) {
    const auto inclination_deg = value_of("inclination", name, written),
               azimuth_deg = value_of("azimuth", name, written);
    if (!inclination_deg || !azimuth_deg || stone.solid.facets.empty()) return {};
    const Vec3 up = up_of(stone);
    const PlanFrame frame = plan_frame(up);
    const double zero = azimuth_zero(frame, written, stone);
    std::set<std::string> read;
    for (const WrittenReading& w : written) read.insert(w.of.begin(), w.of.end());
    // An inclination does not say whether it counts from above or below.
    double least = 1e9;
    std::string nearest, corners;
    for (const int side : {1, -1}) {
        const double i = radians(*inclination_deg), a = radians(*azimuth_deg) - zero;
        const Vec3 n =
            std::sin(i) * (std::cos(a) * frame.x + std::sin(a) * frame.y) + side * std::cos(i) * up;
        for (const Facet& facet : stone.solid.facets) {
            if (read.count(facet.name) > 0 || facet.name == stone.up_facet) continue;
            const double off = angle_between(n, facet.plane.normal);
            if (off < least) {
                least = off;
                nearest = facet.name;
            }
        }
        std::size_t top = 0;
        for (std::size_t v = 0; v < stone.solid.vertices.size(); ++v) {
            if (glm::dot(n, stone.solid.vertices[v]) > glm::dot(n, stone.solid.vertices[top])) {
                top = v;
            }
        }
        std::string there;
        for (const Facet& facet : stone.solid.facets) {
            for (const int corner : facet.corners) {
                if (corner == static_cast<int>(top)) {
                    there += (there.empty() ? "" : ", ") + facet.name;
                }
            }
        }
        if (*inclination_deg < 89.5 || side > 0) {
            corners += (corners.empty() ? "at the corner of " : ", or below at that of ") + there;
        }
    }
    const std::string says = fmt::format("; its readings (inclination {:g}, azimuth {:g}) ",
                                         *inclination_deg, *azimuth_deg);
    if (degrees(least) < k_same_deg) {
        return says + fmt::format("suit facet '{}' of the mesh, of which nothing is read", nearest);
    }
    return says + fmt::format("put it {}: a facet that the mesh lacks?", corners);
}

}  // namespace culet
