// From readings to equations, for the corners that carry them at a given shape.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "fit/model/constants.h"
#include "fit/model/inclination_side.h"
#include "fit/model/outline_corners.h"
#include "fit/model/symmetry_contrasts.h"
#include "fit/model/system.h"

namespace culet {

namespace {

// The line in which two planes cross turns round where they pass through one plane, the line
// through two corners where these pass each other. Lengths go by the one that is farther from
// turning: a facet that turns by an angle moves corners by about as many half diameters.
bool is_nearly_one_plane(const Shape& shape, int a, int b, const Corner& from, const Corner& to) {
    const double sine = glm::length(glm::cross(shape.normals[a], shape.normals[b]));
    return sine <
           k_shapes.nearly_one_plane * glm::length(place_of(shape, to) - place_of(shape, from));
}

// Formulas of one reading's terms under its aggregate.
Formula aggregated(const Reading& reading, std::vector<Formula> terms, const Shape& shape) {
    if (terms.size() == 1) return terms.front();
    if (reading.aggregate == Aggregate::mean || reading.aggregate == Aggregate::single) {
        return mean_of(std::move(terms));
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i < terms.size(); ++i) {
        const double mine = terms[i](shape).value, held = terms[best](shape).value;
        if (reading.aggregate == Aggregate::min ? mine < held : mine > held) best = i;
    }
    return terms[best];
}

}  // namespace

std::vector<Corner> System::corners_between_jaws(const Reading& reading,
                                                 const Outline& outline) const {
    if (reading.kind != ReadingKind::table_width) return outline.corners;
    return corners_of(outline.loops[up_facet_].size() >= 3 ? outline : *mesh_outline_, up_facet_);
}

// The equations of all readings at one shape, kind by kind.
class System::ReadingEquations {
public:
    ReadingEquations(const System& system, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline, bool meets_hold)
        : system_(system), shape_(shape), outline_(outline), meets_hold_(meets_hold) {
        find_girdle();
    }

    /// `replicates`: what this reading and others of the same say together.
    void add(int r, std::optional<Replicates> replicates);
    std::vector<Equation> take() { return std::move(all_); }

private:
    void find_girdle();
    void inclination(const Reading& reading);
    Formula tilt(const Reading& reading, int facet) const;
    void angle_or_edge(const Reading& reading);
    void distance(const Reading& reading);
    void caliper(const Reading& reading, const Vec3& direction);
    void parallel(const Reading& reading);
    void symmetry(const Reading& reading);
    void pair(const Reading& reading, int f, int g);

    Formula edge_formula(int a, int b) const;
    // Corners and edges as they are now; of a facet that is not there, as in the mesh.
    std::vector<Corner> loop_of(int f) const {
        return corners_of(outline_->loops[f].size() >= 3 ? *outline_ : *system_.mesh_outline_, f);
    }
    std::vector<Corner> edge_of(int a, int b) const {
        std::vector<Corner> ends = shared_edge(*outline_, a, b);
        return ends.empty() ? shared_edge(*system_.mesh_outline_, a, b) : ends;
    }
    Vec3 caliper_direction(const Reading& reading) const;
    void put(Formula formula, double value) {
        all_.push_back(base_);
        all_.back().formula = std::move(formula);
        all_.back().value = value;
    }

    const System& system_;
    const Shape& shape_;
    const std::shared_ptr<const Outline>& outline_;
    bool meets_hold_;
    std::vector<int> girdle_;
    std::vector<Corner> girdle_corners_;
    Equation base_;  // of the reading that is being added
    std::vector<Equation> all_;
};

void System::ReadingEquations::find_girdle() {
    const Solid& solid = system_.solid_;
    std::vector<bool> girdle_point(solid.vertices.size(), false);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (!system_.is_girdle(static_cast<int>(f))) continue;
        girdle_.push_back(static_cast<int>(f));
        for (int corner : solid.facets[f].corners) girdle_point[corner] = true;
    }
    if (girdle_.empty()) {
        for (std::size_t v = 0; v < girdle_point.size(); ++v) {
            bool above = false, below = false;
            for (int f : system_.edges_.facets_of_vertex[v]) {
                (solid.facets[f].plane.normal.z > 0 ? above : below) = true;
            }
            girdle_point[v] = above && below;
        }
    }
    for (std::size_t v = 0; v < girdle_point.size(); ++v) {
        if (girdle_point[v]) girdle_corners_.push_back({static_cast<int>(v), {-1, -1, -1}});
    }
}

void System::ReadingEquations::add(int r, std::optional<Replicates> replicates) {
    const Reading& reading = system_.readings_[std::size_t(r)];
    const double unit = system_.unit_of(reading);
    base_ = Equation();
    base_.reading = r;
    base_.exact = reading.exact;
    base_.value = reading.value / unit;
    base_.sigma = reading.exact ? 1 : reading.sigma / unit;
    if (replicates) {
        base_.value = replicates->value;
        base_.sigma = replicates->sigma;
        base_.scatter = replicates->scatter;
        base_.replicates = std::move(replicates->all);
    }
    switch (reading.kind) {
        case ReadingKind::inclination:
            return inclination(reading);
        case ReadingKind::azimuth: {
            const int datum = reading.datum.kind == Datum::Kind::facet ? reading.datum.facet : -1;
            return put(azimuth_error(reading.facets[0], datum, base_.value), 0);
        }
        case ReadingKind::dihedral:
        case ReadingKind::edge:
            return angle_or_edge(reading);
        case ReadingKind::distance:
            return distance(reading);
        case ReadingKind::width:
        case ReadingKind::depth:
        case ReadingKind::table_width:
            return caliper(reading, caliper_direction(reading));
        case ReadingKind::volume:
        case ReadingKind::weight:
            return put(enclosed_volume(outline_), base_.value);
        case ReadingKind::meet:        // an incidence
        case ReadingKind::silhouette:  // known_plane_equations.cpp
        case ReadingKind::photograph:
            return;
        case ReadingKind::parallel:
        case ReadingKind::coplanar:
            return parallel(reading);
        case ReadingKind::rotation:
        case ReadingKind::mirror:
            return symmetry(reading);
    }
}

Formula System::ReadingEquations::tilt(const Reading& reading, int f) const {
    switch (reading.datum.kind) {
        case Datum::Kind::up:
            return tilt_from_side(
                f, reading.side != 0 ? reading.side : side_of(shape_.normals[f], base_.value));
        case Datum::Kind::facet:
            return tilt_between(f, reading.datum.facet);
        case Datum::Kind::axis:
            return girdle_.size() < 2 ? tilt_from_up(f) : tilt_from_axis(f, girdle_);
        case Datum::Kind::girdle:
            break;
    }
    return girdle_corners_.size() < 3 ? tilt_from_up(f) : tilt_from_plane(f, girdle_corners_);
}

void System::ReadingEquations::inclination(const Reading& reading) {
    const bool is_plain =
        reading.aggregate == Aggregate::single && reading.datum.kind == Datum::Kind::up;
    if (reading.value == 0 && is_plain) {
        const int f = reading.facets[0];
        if (f == system_.up_facet_) {
            put(tilt_from_up(f), 0);
            all_.back().exact = false;
            return;
        }
        put(horizontal_component(f, 0), 0);
        put(horizontal_component(f, 1), 0);
        return;
    }
    std::vector<Formula> terms;
    for (int f : reading.facets) terms.push_back(tilt(reading, f));
    put(aggregated(reading, std::move(terms), shape_), base_.value);
    if (is_plain && reading.side == 0) all_.back().other_value = std::numbers::pi - base_.value;
}

Formula System::ReadingEquations::edge_formula(int a, int b) const {
    const std::vector<Corner> ends = edge_of(a, b);
    const bool has_line = meets_hold_ && system_.stone_.convex && ends[0].point >= 0 &&
                          ends[1].point >= 0 &&
                          !is_nearly_one_plane(shape_, a, b, ends[0], ends[1]);
    return has_line ? edge_length(a, b, ends[0], ends[1]) : corner_distance(ends[0], ends[1]);
}

void System::ReadingEquations::angle_or_edge(const Reading& reading) {
    const bool is_edge = reading.kind == ReadingKind::edge;
    std::vector<Formula> terms;
    for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
        const int a = reading.facets[i], b = reading.facets[i + 1];
        terms.push_back(is_edge ? edge_formula(a, b) : interior_angle(a, b));
    }
    put(aggregated(reading, std::move(terms), shape_), base_.value);
    all_.back().has_kink = is_edge;
}

void System::ReadingEquations::distance(const Reading& reading) {
    using Kind = Place::Kind;
    Place a = reading.places[0], b = reading.places[1];
    if (a.kind > b.kind) std::swap(a, b);  // facet, vertex, edge
    const Corner va{a.vertex, {-1, -1, -1}}, vb{b.vertex, {-1, -1, -1}};
    const std::vector<Corner> eb =
        b.kind == Kind::edge ? edge_of(b.facet, b.other_facet) : std::vector<Corner>();
    const auto formula = [&]() -> Formula {
        if (a.kind == Kind::facet && b.kind == Kind::facet) {
            return spacing(a.facet, b.facet, loop_of(a.facet), loop_of(b.facet));
        }
        if (a.kind == Kind::facet && b.kind == Kind::vertex) return corner_to_facet(a.facet, vb);
        if (a.kind == Kind::facet) {
            return mean_of({corner_to_facet(a.facet, eb[0]), corner_to_facet(a.facet, eb[1])});
        }
        if (a.kind == Kind::vertex && b.kind == Kind::vertex) return corner_distance(va, vb);
        if (a.kind == Kind::vertex) return corner_to_line(va, eb[0], eb[1]);
        const std::vector<Corner> ea = edge_of(a.facet, a.other_facet);
        return line_to_line(ea[0], ea[1], eb[0], eb[1]);
    };
    put(formula(), base_.value);
}

Vec3 System::ReadingEquations::caliper_direction(const Reading& reading) const {
    if (reading.kind == ReadingKind::depth) return {0, 0, 1};
    if (reading.kind == ReadingKind::width && reading.has_direction) {
        return system_.inside_direction(reading.direction);
    }
    return {std::cos(reading.azimuth), std::sin(reading.azimuth), 0};
}

void System::ReadingEquations::caliper(const Reading& reading, const Vec3& direction) {
    const std::vector<Corner> corners = system_.corners_between_jaws(reading, *outline_);
    const std::array<Corner, 2> touched{farthest(shape_, corners, direction),
                                        farthest(shape_, corners, -direction)};
    put(extent(touched[0], touched[1], direction), base_.value);
    all_.back().touched = touched;
    all_.back().caliper = direction;
}

void System::ReadingEquations::parallel(const Reading& reading) {
    base_.role = Equation::Role::relation;
    const int first = reading.facets[0];
    const bool is_coplanar = reading.kind == ReadingKind::coplanar;
    for (std::size_t i = 1; i < reading.facets.size(); ++i) {
        const int f = reading.facets[i];
        const double sign =
            is_coplanar || glm::dot(shape_.normals[f], shape_.normals[first]) > 0 ? 1 : -1;
        for (const Vec3& t : tangents(shape_.normals[first])) {
            put(normal_difference(f, first, sign, t), 0);
        }
        if (is_coplanar) put(offset_difference(f, first, sign), 0);
    }
}

void System::ReadingEquations::symmetry(const Reading& reading) {
    base_.role = Equation::Role::relation;
    const auto& pairs = system_.pairs_[std::size_t(base_.reading)];
    // Within sigma: directions each with an error of its own, distances each by its image's, so
    // that a round girdle may be slowly out of round.
    if (reading.kind == ReadingKind::rotation && !reading.exact) {
        const double angle = radians(360.0 / reading.order);
        for (const std::vector<int>& orbit : orbits_of_pairs(pairs)) {
            for (Formula& contrast : turn_contrasts(system_.mesh_shape_, orbit, angle)) {
                put(std::move(contrast), 0);
            }
        }
    }
    const double sigma = reading.sigma / system_.unit_of(reading);
    for (const auto& [f, g] : pairs) {
        // Two facets, each with an error of its own, differ by more.
        if (!reading.exact) base_.sigma = (f == g ? 1 : std::numbers::sqrt2) * sigma;
        pair(reading, f, g);
    }
}

// Facet f comes to lie on facet g.
void System::ReadingEquations::pair(const Reading& reading, int f, int g) {
    const bool is_rotation = reading.kind == ReadingKind::rotation;
    const double angle = reading.order > 0 ? radians(360.0 / reading.order) : 0;
    const int extra = system_.first_extra_[std::size_t(base_.reading)];
    const MirrorPlane plane{reading.has_direction ? -1 : extra + 1, extra, reading.azimuth};
    if (f == g && f == system_.up_facet_) return;
    if (f == g && !is_rotation) return put(across_mirror(f, plane), 0);
    if (f == g) {
        // Only a level facet is its own image in a turn.
        for (int k = 0; k < 2; ++k) put(horizontal_component(f, k), 0);
        return;
    }
    const std::vector<Corner> corners = corners_of(*system_.mesh_outline_, f);
    if (!is_rotation || reading.exact) {
        for (const Vec3& t : tangents(shape_.normals[g])) {
            put(is_rotation ? turned_normal(f, g, angle, t) : mirrored_normal(f, g, plane, t), 0);
        }
    }
    put(is_rotation ? turned_height(corners, g, angle, extra) : mirrored_height(corners, g, plane),
        0);
}

std::vector<Equation> System::reading_equations(const Shape& shape,
                                                const std::shared_ptr<const Outline>& outline,
                                                bool reduced, bool meets_hold) const {
    MergedReadings merged = merged_readings(shape);
    ReadingEquations equations(*this, shape, outline, meets_hold);
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        if (merged.is_merged[r]) continue;
        if (reduced && first_extra_[r] >= 0 && fixed_extras_[first_extra_[r]]) continue;
        equations.add(int(r), std::move(merged.replicates[r]));
    }
    std::vector<Equation> all = equations.take(), expected = expected_equations();
    std::move(expected.begin(), expected.end(), std::back_inserter(all));
    std::vector<Equation> of_planes = known_plane_equations();
    std::move(of_planes.begin(), of_planes.end(), std::back_inserter(all));
    return all;
}

}  // namespace culet
