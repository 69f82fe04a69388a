// Makes equations of the readings, for the corners that carry them at a given shape.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "fit/model/constants.h"
#include "fit/model/equations.h"
#include "fit/model/inclination_side.h"
#include "fit/model/outline_corners.h"

namespace culet {

namespace {

// The crossing line of two planes flips where they become one plane; the line through two corners
// flips where these pass each other. An edge's length uses the line that is farther from flipping:
// tilting a facet by an angle moves corners by about as many half diameters.
bool is_nearly_one_plane(const Shape& shape, int a, int b, const Corner& from, const Corner& to) {
    const double sine = glm::length(glm::cross(shape.normals[a], shape.normals[b]));
    return sine <
           k_shapes.nearly_one_plane * glm::length(place_of(shape, to) - place_of(shape, from));
}

// Combines the formulas of one reading's terms by its aggregate.
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

std::vector<Corner> corners_between_jaws(const FitModel& model, const Reading& reading,
                                         const Outline& outline) {
    if (reading.kind != ReadingKind::table_width) return outline.corners;
    const int up = model.frame().up_facet();
    return corners_of(outline.loops[up].size() >= 3 ? outline : *model.mesh_outline(), up);
}

namespace {

// The equations of all readings at one shape.
class ReadingEquations {
public:
    ReadingEquations(const FitModel& model, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline, bool meets_hold)
        : model_(model), shape_(shape), outline_(outline), meets_hold_(meets_hold) {
        find_girdle();
    }

    /// `replicates`: what this reading and others of the same quantity say together.
    void add(int r, std::optional<Replicates> replicates);
    void append(std::vector<Equation> own) {
        std::move(own.begin(), own.end(), std::back_inserter(all_));
    }
    std::vector<Equation> take() { return std::move(all_); }

private:
    void find_girdle();
    void inclination(const Reading& reading);
    Formula tilt(const Reading& reading, int facet) const;
    void angle_or_edge(const Reading& reading);
    void distance(const Reading& reading);
    void caliper(const Reading& reading, const Vec3& direction);

    Formula edge_formula(int a, int b) const;
    // Corners and edges at this shape; for a missing facet, those of the mesh.
    std::vector<Corner> loop_of(int f) const {
        return corners_of(outline_->loops[f].size() >= 3 ? *outline_ : *model_.mesh_outline(), f);
    }
    std::vector<Corner> edge_of(int a, int b) const {
        std::vector<Corner> ends = shared_edge(*outline_, a, b);
        return ends.empty() ? shared_edge(*model_.mesh_outline(), a, b) : ends;
    }
    Vec3 caliper_direction(const Reading& reading) const;
    void put(Formula formula, double value) {
        all_.push_back(base_);
        all_.back().formula = std::move(formula);
        all_.back().value = value;
    }

    const FitModel& model_;
    const Shape& shape_;
    const std::shared_ptr<const Outline>& outline_;
    bool meets_hold_;
    std::vector<int> girdle_;
    std::vector<Corner> girdle_corners_;
    Equation base_;  // of the reading that is being added
    std::vector<Equation> all_;
};

void ReadingEquations::find_girdle() {
    const Solid& solid = model_.frame().solid();
    std::vector<bool> girdle_point(solid.vertices.size(), false);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (!model_.frame().is_girdle(static_cast<int>(f))) continue;
        girdle_.push_back(static_cast<int>(f));
        for (int corner : solid.facets[f].corners) girdle_point[corner] = true;
    }
    if (girdle_.empty()) {
        for (std::size_t v = 0; v < girdle_point.size(); ++v) {
            bool above = false, below = false;
            for (int f : model_.edges().facets_of_vertex[v]) {
                (solid.facets[f].plane.normal.z > 0 ? above : below) = true;
            }
            girdle_point[v] = above && below;
        }
    }
    for (std::size_t v = 0; v < girdle_point.size(); ++v) {
        if (girdle_point[v]) girdle_corners_.push_back({static_cast<int>(v), {-1, -1, -1}});
    }
}

void ReadingEquations::add(int r, std::optional<Replicates> replicates) {
    const Reading& reading = model_.readings()[std::size_t(r)];
    const double unit = model_.frame().unit_of(reading);
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
        case ReadingKind::line:
            return append(line_equations(*model_.lines().of(std::size_t(r)), base_));
        case ReadingKind::parallel:
        case ReadingKind::coplanar:
        case ReadingKind::rotation:
        case ReadingKind::mirror:
            return append(relation_equations(model_, shape_, base_));
    }
}

Formula ReadingEquations::tilt(const Reading& reading, int f) const {
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

void ReadingEquations::inclination(const Reading& reading) {
    const bool is_plain =
        reading.aggregate == Aggregate::single && reading.datum.kind == Datum::Kind::up;
    if (reading.value == 0 && is_plain) {
        const int f = reading.facets[0];
        if (f == model_.frame().up_facet()) {
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

Formula ReadingEquations::edge_formula(int a, int b) const {
    const std::vector<Corner> ends = edge_of(a, b);
    const bool has_line = meets_hold_ && model_.stone().convex && ends[0].point >= 0 &&
                          ends[1].point >= 0 &&
                          !is_nearly_one_plane(shape_, a, b, ends[0], ends[1]);
    return has_line ? edge_length(a, b, ends[0], ends[1]) : corner_distance(ends[0], ends[1]);
}

void ReadingEquations::angle_or_edge(const Reading& reading) {
    const bool is_edge = reading.kind == ReadingKind::edge;
    std::vector<Formula> terms;
    for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
        const int a = reading.facets[i], b = reading.facets[i + 1];
        terms.push_back(is_edge ? edge_formula(a, b) : interior_angle(a, b));
    }
    put(aggregated(reading, std::move(terms), shape_), base_.value);
    all_.back().has_kink = is_edge;
}

void ReadingEquations::distance(const Reading& reading) {
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

Vec3 ReadingEquations::caliper_direction(const Reading& reading) const {
    if (reading.kind == ReadingKind::depth) return {0, 0, 1};
    if (reading.kind == ReadingKind::width && reading.has_direction) {
        return model_.frame().inside_direction(reading.direction);
    }
    return {std::cos(reading.azimuth), std::sin(reading.azimuth), 0};
}

void ReadingEquations::caliper(const Reading& reading, const Vec3& direction) {
    const std::vector<Corner> corners = corners_between_jaws(model_, reading, *outline_);
    const std::array<Corner, 2> touched{farthest(shape_, corners, direction),
                                        farthest(shape_, corners, -direction)};
    put(extent(touched[0], touched[1], direction), base_.value);
    all_.back().touched = touched;
    all_.back().caliper = direction;
}

}  // namespace

std::vector<Equation> reading_equations(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline, bool reduced,
                                        bool meets_hold) {
    MergedReadings merged = merged_readings(model, shape);
    ReadingEquations equations(model, shape, outline, meets_hold);
    for (std::size_t r = 0; r < model.readings().size(); ++r) {
        if (merged.is_merged[r]) continue;
        if (reduced && model.symmetries().is_kept_by_parameters(r)) continue;
        equations.add(int(r), std::move(merged.replicates[r]));
    }
    equations.append(prior_equations(model.prior()));
    equations.append(known_plane_equations(model.known_planes()));
    equations.append(motion_equations(model.lines()));
    return equations.take();
}

}  // namespace culet
