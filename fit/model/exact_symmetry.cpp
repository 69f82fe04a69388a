// Which facets and meets exact symmetry readings exchange, told by who meets whom, and only then by
// where things lie: a rough mesh has the same exchanges as the stone.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "fit/model/system.h"

namespace culet {

namespace {

bool is_symmetry(const Reading& reading) {
    return reading.kind == ReadingKind::rotation || reading.kind == ReadingKind::mirror;
}

// How far an exchange of points is from a motion about an upright axis through their middle: mean
// square.
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

// The azimuth of the mirror's normal that this exchange is nearest to: the mean of doubled angles.
double mirror_azimuth(const std::vector<Vec3>& points, const std::vector<int>& exchange) {
    double east = 0, north = 0;
    for (std::size_t p = 0; p < exchange.size(); ++p) {
        const Vec3 d = points[p] - points[exchange[p]];
        east += d.x * d.x - d.y * d.y;
        north += 2 * d.x * d.y;
    }
    return 0.5 * std::atan2(north, east);
}

}  // namespace

void System::find_exchanges() {
    exchanges_.resize(readings_.size());
    if (std::none_of(readings_.begin(), readings_.end(), is_symmetry)) return;
    std::vector<Automorphism> all = automorphisms(solid_);
    if (up_facet_ >= 0) all = that_keep(all, up_facet_);
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        const Reading& reading = readings_[r];
        if (!is_symmetry(reading)) continue;
        const bool in_pairs = reading.kind == ReadingKind::mirror && !reading.has_direction;
        if (!in_pairs && !reading.facets.empty() && reading.facets.size() != solid_.facets.size()) {
            continue;
        }
        double least = 1e300;
        for (const Automorphism& a : all) {
            double off = 0;
            if (reading.kind == ReadingKind::rotation) {
                if (a.turns_over || order_of(a) != reading.order) continue;
                // Round the up facet, by one part of the full turn.
                if (up_facet_ >= 0 &&
                    steps_of_turn(solid_, up_facet_, a) * reading.order !=
                        static_cast<int>(solid_.facets[up_facet_].corners.size())) {
                    continue;
                }
                off = misfit(solid_.vertices, a.vertices,
                             turn_about_z(2 * std::numbers::pi / reading.order));
            } else if (!a.turns_over || order_of(a) != 2) {
                continue;
            } else if (in_pairs) {
                std::size_t named = 0;
                bool fits = true;
                for (std::size_t i = 0; fits && i + 1 < reading.facets.size(); i += 2) {
                    const int f = reading.facets[i], g = reading.facets[i + 1];
                    fits = a.facets[f] == g;
                    named += f == g ? 1 : 2;
                }
                // Facets that go unnamed must be their own images.
                for (std::size_t f = 0; fits && f < a.facets.size(); ++f) {
                    if (std::find(reading.facets.begin(), reading.facets.end(), int(f)) ==
                        reading.facets.end()) {
                        fits = a.facets[f] == int(f);
                    }
                }
                if (!fits || named == 0) continue;
            } else {
                off = misfit(solid_.vertices, a.vertices, mirroring_at(reading.azimuth));
            }
            if (off < least) {
                least = off;
                exchanges_[r] = a;
            }
        }
    }
}

void System::list_exact_motions() {
    fixed_extras_.assign(mesh_shape_.extras.size(), false);
    if (splits_ || mesh_shape_.points.size() != solid_.vertices.size()) return;
    const bool sees_azimuth =
        stone_.azimuth_from_mesh ||
        std::any_of(readings_.begin(), readings_.end(), [](const Reading& r) {
            return (r.kind == ReadingKind::azimuth && r.datum.kind != Datum::Kind::facet) ||
                   r.kind == ReadingKind::width || r.kind == ReadingKind::table_width;
        });
    std::vector<SymmetryMotion> motions;
    std::vector<bool> fixed = fixed_extras_;
    // Pairs say nothing of where their mirror stands; any azimuth will do when no other mirror and
    // no reading knows better.
    bool has_placed_mirror = false;
    for (const Reading& r : readings_) {
        has_placed_mirror = has_placed_mirror || (r.kind == ReadingKind::mirror && r.has_direction);
    }
    bool placed_by_pairs = false;
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        const Reading& reading = readings_[r];
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
            const double azimuth = mirror_azimuth(solid_.vertices, motion.exchange.vertices);
            motion.motion = mirroring_at(azimuth);
            mesh_shape_.extras[extra + 1] = azimuth;
            fixed[extra] = fixed[extra + 1] = true;
        }
        motions.push_back(std::move(motion));
    }
    if (motions.empty()) return;
    if (!orbits_of(motions, static_cast<int>(solid_.facets.size()),
                   static_cast<int>(solid_.vertices.size()))) {
        return;
    }
    exact_motions_ = std::move(motions);
    fixed_extras_ = std::move(fixed);
}

Parameters System::parameters() const {
    Orbits orbits;
    if (!exact_motions_.empty()) {
        orbits = *orbits_of(exact_motions_, static_cast<int>(mesh_shape_.normals.size()),
                            static_cast<int>(mesh_shape_.points.size()));
    }
    return Parameters(mesh_shape_, up_facet_, std::move(orbits), fixed_extras_);
}

}  // namespace culet
