// Finds which facets and meets exact symmetry readings exchange: by the topology first, so that a
// rough mesh has the same exchanges as the stone.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "fit/model/symmetries.h"

namespace culet {

namespace {

bool is_symmetry(const Reading& reading) {
    return reading.kind == ReadingKind::rotation || reading.kind == ReadingKind::mirror;
}

// Mean square distance of an exchange of points from a motion about an upright axis through their
// middle.
double misfit(const std::vector<Vec3>& points, const std::vector<int>& exchange,
              const glm::dmat3& motion) {
    Vec3 middle(0);
    for (std::size_t p = 0; p < exchange.size(); ++p) middle += points[p] / double(exchange.size());
    double sum = 0;
    for (std::size_t p = 0; p < exchange.size(); ++p) {
        const Vec3 off = motion * (points[p] - middle) - (points[exchange[p]] - middle);
        sum += glm::dot(off, off) / double(exchange.size());
    }
    return sum;
}

// Azimuth of the normal of the mirror nearest to this exchange: the mean of doubled angles.
double mirror_azimuth(const std::vector<Vec3>& points, const std::vector<int>& exchange) {
    double east = 0, north = 0;
    for (std::size_t p = 0; p < exchange.size(); ++p) {
        const Vec3 d = points[p] - points[exchange[p]];
        east += d.x * d.x - d.y * d.y;
        north += 2 * d.x * d.y;
    }
    return 0.5 * std::atan2(north, east);
}

bool is_in_pairs(const Reading& reading) {
    return reading.kind == ReadingKind::mirror && !reading.has_direction;
}

// Whether this exchange swaps the facets named in pairs and maps all unnamed ones to themselves.
bool exchanges_pairs(const std::vector<int>& named, const Automorphism& a) {
    if (named.size() < 2) return false;
    for (std::size_t i = 0; i + 1 < named.size(); i += 2) {
        if (a.facets[named[i]] != named[i + 1]) return false;
    }
    for (std::size_t f = 0; f < a.facets.size(); ++f) {
        const bool is_named = std::find(named.begin(), named.end(), int(f)) != named.end();
        if (!is_named && a.facets[f] != int(f)) return false;
    }
    return true;
}

// How far the mesh is from the reading's symmetry under this exchange; nothing where the exchange
// is no such symmetry.
std::optional<double> misfit_under(const Reading& reading, const Automorphism& a,
                                   const Solid& solid, int up_facet) {
    if (reading.kind == ReadingKind::rotation) {
        if (a.turns_over || order_of(a) != reading.order) return std::nullopt;
        // It must turn the up facet by exactly one step of the rotation.
        if (up_facet >= 0 && steps_of_turn(solid, up_facet, a) * reading.order !=
                                 static_cast<int>(solid.facets[up_facet].corners.size())) {
            return std::nullopt;
        }
        return misfit(solid.vertices, a.vertices,
                      turn_about_z(2 * std::numbers::pi / reading.order));
    }
    if (!a.turns_over || order_of(a) != 2) return std::nullopt;
    if (!is_in_pairs(reading)) {
        return misfit(solid.vertices, a.vertices, mirroring_at(reading.azimuth));
    }
    if (!exchanges_pairs(reading.facets, a)) return std::nullopt;
    return 0;
}

}  // namespace

Symmetries::Symmetries(const Stone& stone, const Frame& frame, const std::vector<Reading>& readings,
                       bool splits, Shape& shape) {
    add_extras(readings, shape);
    find_exchanges(frame, readings);
    pair_facets(readings, shape);
    fixed_extras_.assign(shape.extras.size(), false);
    const bool has_added_points = shape.points.size() != frame.solid().vertices.size();
    if (!splits && !has_added_points) list_exact_motions(stone, frame, readings, shape);
}

void Symmetries::add_extras(const std::vector<Reading>& readings, Shape& shape) {
    first_extra_.assign(readings.size(), -1);
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (!is_symmetry(reading)) continue;
        first_extra_[r] = static_cast<int>(shape.extras.size());
        if (reading.kind == ReadingKind::rotation) {
            shape.extras.insert(shape.extras.end(), {0.0, 0.0});
            continue;
        }
        shape.extras.push_back(0.0);  // distance of the plane from the middle
        if (reading.has_direction) continue;
        // The normals of a pair differ along the mirror's normal, up to sign: take the mean of
        // doubled angles.
        double east = 0, north = 0;
        for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
            const Vec3 d = shape.normals[reading.facets[i]] - shape.normals[reading.facets[i + 1]];
            east += d.x * d.x - d.y * d.y;
            north += 2 * d.x * d.y;
        }
        shape.extras.push_back(0.5 * std::atan2(north, east));
    }
}

void Symmetries::find_exchanges(const Frame& frame, const std::vector<Reading>& readings) {
    const Solid& solid = frame.solid();
    const int up_facet = frame.up_facet();
    exchanges_.resize(readings.size());
    if (std::none_of(readings.begin(), readings.end(), is_symmetry)) return;
    std::vector<Automorphism> all = automorphisms(solid);
    if (up_facet >= 0) all = that_keep(all, up_facet);
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (!is_symmetry(reading)) continue;
        if (!is_in_pairs(reading) && !reading.facets.empty() &&
            reading.facets.size() != solid.facets.size()) {
            continue;
        }
        double least = 1e300;
        for (const Automorphism& a : all) {
            const std::optional<double> off = misfit_under(reading, a, solid, up_facet);
            if (!off || *off >= least) continue;
            least = *off;
            exchanges_[r] = a;
        }
    }
}

void Symmetries::list_exact_motions(const Stone& stone, const Frame& frame,
                                    const std::vector<Reading>& readings, Shape& shape) {
    const Solid& solid = frame.solid();
    const bool sees_azimuth =
        stone.azimuth_from_mesh ||
        std::any_of(readings.begin(), readings.end(), [](const Reading& r) {
            return (r.kind == ReadingKind::azimuth && r.datum.kind != Datum::Kind::facet) ||
                   r.kind == ReadingKind::width || r.kind == ReadingKind::table_width;
        });
    std::vector<SymmetryMotion> motions;
    std::vector<bool> fixed = fixed_extras_;
    // Pairs do not tell the azimuth of their mirror. Any will do when no other mirror and no
    // reading determines it.
    bool has_placed_mirror = false;
    for (const Reading& r : readings) {
        has_placed_mirror = has_placed_mirror || (r.kind == ReadingKind::mirror && r.has_direction);
    }
    bool placed_by_pairs = false;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        if (!is_symmetry(reading) || !reading.exact || !exchanges_[r]) continue;
        const int extra = first_extra_[r];
        SymmetryMotion motion{*exchanges_[r], glm::dmat3(1.0)};
        if (reading.kind == ReadingKind::rotation) {
            motion.motion = turn_about_z(2 * std::numbers::pi / reading.order);
            fixed[extra] = fixed[extra + 1] = true;
        } else if (reading.has_direction) {
            motion.motion = mirroring_at(reading.azimuth);
            fixed[extra] = true;
        } else {
            if (sees_azimuth || has_placed_mirror || placed_by_pairs) continue;
            placed_by_pairs = true;
            const double azimuth = mirror_azimuth(solid.vertices, motion.exchange.vertices);
            motion.motion = mirroring_at(azimuth);
            shape.extras[extra + 1] = azimuth;
            fixed[extra] = fixed[extra + 1] = true;
        }
        motions.push_back(std::move(motion));
    }
    if (motions.empty()) return;
    if (!orbits_of(motions, static_cast<int>(solid.facets.size()),
                   static_cast<int>(solid.vertices.size()))) {
        return;
    }
    exact_motions_ = std::move(motions);
    fixed_extras_ = std::move(fixed);
}

Parameters Symmetries::parameters(const Shape& shape, int up_facet) const {
    Orbits orbits;
    if (!exact_motions_.empty()) {
        orbits = *orbits_of(exact_motions_, static_cast<int>(shape.normals.size()),
                            static_cast<int>(shape.points.size()));
    }
    std::vector<bool> fixed = fixed_extras_;
    fixed.resize(shape.extras.size(), false);  // the prior's
    return Parameters(shape, up_facet, std::move(orbits), fixed);
}

}  // namespace culet
