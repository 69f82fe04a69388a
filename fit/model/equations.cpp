// From readings to equations, for the corners that carry them at a given shape.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "fit/model/symmetry_contrasts.h"
#include "fit/model/system.h"

namespace culet {

namespace {

// Softening of incidences that are released: they come apart by this much of the half diameter
// before the point that stands for them lags behind.
constexpr double k_released_sigma = 0.2;
// A hand-made mesh is off by as much as 20 % of its width.
constexpr double k_mesh_sigma = 0.4;

// Of an edge's length: planes whose sine is less are told apart by less than the edge's ends are.
constexpr double k_nearly_one_plane = 0.3;

std::vector<Corner> corners_of(const Outline& outline, int facet) {
    std::vector<Corner> corners;
    for (int c : outline.loops[facet]) corners.push_back(outline.corners[c]);
    return corners;
}

// The two ends of the edge that two loops share, or nothing.
std::vector<Corner> shared_edge(const Outline& outline, int a, int b) {
    const std::vector<int>&loop = outline.loops[a], &other = outline.loops[b];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        for (std::size_t k = 0; k < other.size(); ++k) {
            if (other[k] == to && other[(k + 1) % other.size()] == from) {
                return {outline.corners[from], outline.corners[to]};
            }
        }
    }
    return {};
}

// The line in which two planes cross turns round where they pass through one plane, the line
// through two corners where these pass each other. Lengths go by the one that is farther from
// turning: a facet that turns by an angle moves corners by about as many half diameters.
bool is_nearly_one_plane(const Shape& shape, int a, int b, const Corner& from, const Corner& to) {
    const double sine = glm::length(glm::cross(shape.normals[a], shape.normals[b]));
    return sine < k_nearly_one_plane * glm::length(place_of(shape, to) - place_of(shape, from));
}

Corner farthest(const Shape& shape, const std::vector<Corner>& corners, const Vec3& direction) {
    Corner best = corners.front();
    double most = -1e300;
    for (const Corner& c : corners) {
        const double along = glm::dot(direction, place_of(shape, c));
        if (along > most) {
            most = along;
            best = c;
        }
    }
    return best;
}

bool is_nearly_upright(const Vec3& normal) {
    return std::abs(normal.z) < std::sin(radians(5));
}

// Whether an inclination counts from above or from below. A reading of a nearly upright facet does
// not say on which side of upright it is: the nearer one is meant.
int side_of(const Vec3& normal, double inclination_read) {
    const int side = normal.z < 0 ? -1 : 1;
    const double from_up = std::atan2(std::hypot(normal.x, normal.y), side * normal.z);
    const double from_down = std::numbers::pi - from_up;
    return is_nearly_upright(normal) &&
                   std::abs(from_down - inclination_read) < std::abs(from_up - inclination_read)
               ? -side
               : side;
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

std::vector<Equation> System::equations(const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) const {
    std::vector<Equation> all;
    // The up facet is horizontal: that is what the frame means.
    if (up_facet_ >= 0) {
        for (int k = 0; k < 2; ++k) {
            Equation e;
            e.role = Equation::Role::relation;
            e.exact = true;
            e.formula = horizontal_component(up_facet_, k);
            all.push_back(std::move(e));
        }
    }
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = incidences_[i];
        Equation e;
        e.incidence = static_cast<int>(i);
        e.reading = incidence.reading;
        e.role = incidence.how == MeetTreatment::released ? Equation::Role::released
                                                          : Equation::Role::incidence;
        e.exact = incidence.how == MeetTreatment::exact;
        e.sigma = incidence_sigma(incidence);
        if (e.role == Equation::Role::incidence && !e.exact && incidence.sigma == 0 &&
            estimates_meets_) {
            e.group = is_girdle(incidence.facet);
        }
        e.formula = height(incidence.facet, Corner{incidence.point, {-1, -1, -1}});
        all.push_back(std::move(e));
    }
    std::vector<Equation> of_readings = reading_equations(shape, outline);
    std::move(of_readings.begin(), of_readings.end(), std::back_inserter(all));
    return all;
}

double System::incidence_sigma(const Incidence& incidence) const {
    return incidence.how == MeetTreatment::exact      ? 0
           : incidence.how == MeetTreatment::released ? k_released_sigma
           : incidence.sigma > 0                      ? incidence.sigma
                                                      : group_sigmas_[is_girdle(incidence.facet)];
}

bool System::has_exact_readings() const {
    return std::any_of(readings_.begin(), readings_.end(),
                       [](const Reading& r) { return r.exact && r.kind != ReadingKind::meet; });
}

bool System::may_be_merged(const std::vector<int>& group, const Replicates& replicates,
                           const Shape& shape) const {
    const Reading& first = readings_[std::size_t(group.front())];
    if (first.kind == ReadingKind::azimuth) {
        // Further off, some would be wrapped to the other side.
        constexpr double k_most = 3;
        const int datum = first.datum.kind == Datum::Kind::facet ? first.datum.facet : -1;
        const double error = azimuth_error(first.facets[0], datum, replicates.value)(shape).value;
        return std::all_of(replicates.all.begin(), replicates.all.end(),
                           [&](const Replicate& r) { return std::abs(error - r.off) < k_most; });
    }
    if (first.kind != ReadingKind::inclination || first.datum.kind != Datum::Kind::up) return true;
    return std::all_of(group.begin(), group.end(), [&](int r) {
        return std::all_of(first.facets.begin(), first.facets.end(), [&](int f) {
            const Vec3& n = shape.normals[std::size_t(f)];
            return side_of(n, readings_[std::size_t(r)].value) == side_of(n, replicates.value);
        });
    });
}

std::vector<Corner> System::corners_between_jaws(const Reading& reading,
                                                 const Outline& outline) const {
    if (reading.kind != ReadingKind::table_width) return outline.corners;
    return corners_of(outline.loops[up_facet_].size() >= 3 ? outline : *mesh_outline_, up_facet_);
}

std::vector<Equation> System::reading_equations(const Shape& shape,
                                                const std::shared_ptr<const Outline>& outline,
                                                bool reduced, bool meets_hold) const {
    std::vector<Equation> all;
    // Corners, loops and edges as they are now; of a facet that is not there, as in the mesh.
    const auto loop_of = [&](int f) {
        return outline->loops[f].size() >= 3 ? corners_of(*outline, f)
                                             : corners_of(*mesh_outline_, f);
    };
    const auto edge_of = [&](int a, int b) {
        std::vector<Corner> ends = shared_edge(*outline, a, b);
        return ends.empty() ? shared_edge(*mesh_outline_, a, b) : ends;
    };
    std::vector<int> girdle;
    std::vector<Corner> girdle_corners;
    {
        std::vector<bool> girdle_point(solid_.vertices.size(), false);
        for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
            if (is_girdle(static_cast<int>(f))) {
                girdle.push_back(static_cast<int>(f));
                for (int corner : solid_.facets[f].corners) girdle_point[corner] = true;
            }
        }
        if (girdle.empty()) {
            for (std::size_t v = 0; v < girdle_point.size(); ++v) {
                bool above = false, below = false;
                for (int f : edges_.facets_of_vertex[v]) {
                    (solid_.facets[f].plane.normal.z > 0 ? above : below) = true;
                }
                girdle_point[v] = above && below;
            }
        }
        for (std::size_t v = 0; v < girdle_point.size(); ++v) {
            if (girdle_point[v]) girdle_corners.push_back({static_cast<int>(v), {-1, -1, -1}});
        }
    }

    std::vector<std::optional<Replicates>> replicates(readings_.size());  // with the first of them
    std::vector<bool> is_merged(readings_.size(), false);
    for (const std::vector<int>& group : replicated_) {
        const std::size_t first = std::size_t(group.front());
        Replicates own = merged(readings_, group, unit_of(readings_[first]));
        if (!may_be_merged(group, own, shape)) continue;
        replicates[first] = std::move(own);
        for (std::size_t k = 1; k < group.size(); ++k) is_merged[std::size_t(group[k])] = true;
    }
    for (std::size_t r = 0; r < readings_.size(); ++r) {
        if (is_merged[r]) continue;
        const Reading& reading = readings_[r];
        if (reduced && first_extra_[r] >= 0 && fixed_extras_[first_extra_[r]]) continue;
        const double unit = unit_of(reading);
        Equation base;
        base.reading = static_cast<int>(r);
        base.exact = reading.exact;
        base.value = reading.value / unit;
        base.sigma = reading.exact ? 1 : reading.sigma / unit;
        if (replicates[r]) {
            base.value = replicates[r]->value;
            base.sigma = replicates[r]->sigma;
            base.scatter = replicates[r]->scatter;
            base.replicates = std::move(replicates[r]->all);
        }
        const auto put = [&](Formula formula, double value) {
            Equation e = base;
            e.formula = std::move(formula);
            e.value = value;
            all.push_back(std::move(e));
        };
        const auto put_caliper = [&](const std::vector<Corner>& corners, const Vec3& direction) {
            const std::array<Corner, 2> touched{farthest(shape, corners, direction),
                                                farthest(shape, corners, -direction)};
            put(extent(touched[0], touched[1], direction), base.value);
            all.back().touched = touched;
            all.back().caliper = direction;
        };
        switch (reading.kind) {
            case ReadingKind::inclination: {
                if (reading.value == 0 && reading.aggregate == Aggregate::single &&
                    reading.datum.kind == Datum::Kind::up) {
                    if (reading.facets[0] == up_facet_) {
                        put(tilt_from_up(reading.facets[0]), 0);
                        all.back().exact = false;
                        break;
                    }
                    put(horizontal_component(reading.facets[0], 0), 0);
                    put(horizontal_component(reading.facets[0], 1), 0);
                    break;
                }
                std::vector<Formula> terms;
                for (int f : reading.facets) {
                    switch (reading.datum.kind) {
                        case Datum::Kind::up:
                            terms.push_back(
                                tilt_from_side(f, reading.side != 0
                                                      ? reading.side
                                                      : side_of(shape.normals[f], base.value)));
                            break;
                        case Datum::Kind::facet:
                            terms.push_back(tilt_between(f, reading.datum.facet));
                            break;
                        case Datum::Kind::axis:
                            terms.push_back(girdle.size() < 2 ? tilt_from_up(f)
                                                              : tilt_from_axis(f, girdle));
                            break;
                        case Datum::Kind::girdle:
                            terms.push_back(girdle_corners.size() < 3
                                                ? tilt_from_up(f)
                                                : tilt_from_plane(f, girdle_corners));
                            break;
                    }
                }
                put(aggregated(reading, std::move(terms), shape), base.value);
                if (reading.aggregate == Aggregate::single && reading.side == 0 &&
                    reading.datum.kind == Datum::Kind::up) {
                    all.back().other_value = std::numbers::pi - base.value;
                }
                break;
            }
            case ReadingKind::azimuth:
                put(azimuth_error(
                        reading.facets[0],
                        reading.datum.kind == Datum::Kind::facet ? reading.datum.facet : -1,
                        base.value),
                    0);
                break;
            case ReadingKind::dihedral:
            case ReadingKind::edge: {
                std::vector<Formula> terms;
                for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
                    const int a = reading.facets[i], b = reading.facets[i + 1];
                    if (reading.kind == ReadingKind::dihedral) {
                        terms.push_back(interior_angle(a, b));
                    } else {
                        const std::vector<Corner> ends = edge_of(a, b);
                        terms.push_back(meets_hold && stone_.convex && ends[0].point >= 0 &&
                                                ends[1].point >= 0 &&
                                                !is_nearly_one_plane(shape, a, b, ends[0], ends[1])
                                            ? edge_length(a, b, ends[0], ends[1])
                                            : corner_distance(ends[0], ends[1]));
                    }
                }
                put(aggregated(reading, std::move(terms), shape), base.value);
                all.back().has_kink = reading.kind == ReadingKind::edge;
                break;
            }
            case ReadingKind::distance: {
                Place a = reading.places[0], b = reading.places[1];
                if (a.kind > b.kind) std::swap(a, b);  // facet, vertex, edge
                const Corner va{a.vertex, {-1, -1, -1}}, vb{b.vertex, {-1, -1, -1}};
                const std::vector<Corner> eb = b.kind == Place::Kind::edge
                                                   ? edge_of(b.facet, b.other_facet)
                                                   : std::vector<Corner>();
                if (a.kind == Place::Kind::facet && b.kind == Place::Kind::facet) {
                    put(spacing(a.facet, b.facet, loop_of(a.facet), loop_of(b.facet)), base.value);
                } else if (a.kind == Place::Kind::facet && b.kind == Place::Kind::vertex) {
                    put(corner_to_facet(a.facet, vb), base.value);
                } else if (a.kind == Place::Kind::facet) {
                    put(mean_of({corner_to_facet(a.facet, eb[0]), corner_to_facet(a.facet, eb[1])}),
                        base.value);
                } else if (a.kind == Place::Kind::vertex && b.kind == Place::Kind::vertex) {
                    put(corner_distance(va, vb), base.value);
                } else if (a.kind == Place::Kind::vertex) {
                    put(corner_to_line(va, eb[0], eb[1]), base.value);
                } else {
                    const std::vector<Corner> ea = edge_of(a.facet, a.other_facet);
                    put(line_to_line(ea[0], ea[1], eb[0], eb[1]), base.value);
                }
                break;
            }
            case ReadingKind::width:
            case ReadingKind::depth: {
                Vec3 direction{0, 0, 1};
                if (reading.kind == ReadingKind::width && !reading.has_direction) {
                    direction = {std::cos(reading.azimuth), std::sin(reading.azimuth), 0};
                } else if (reading.kind == ReadingKind::width) {
                    direction = inside_direction(reading.direction);
                }
                put_caliper(corners_between_jaws(reading, *outline), direction);
                break;
            }
            case ReadingKind::table_width: {
                const Vec3 direction{std::cos(reading.azimuth), std::sin(reading.azimuth), 0};
                put_caliper(corners_between_jaws(reading, *outline), direction);
                break;
            }
            case ReadingKind::volume:
            case ReadingKind::weight:
                put(enclosed_volume(outline), base.value);
                break;
            case ReadingKind::meet:
                break;  // an incidence
            case ReadingKind::parallel:
            case ReadingKind::coplanar: {
                base.role = Equation::Role::relation;
                const int first = reading.facets[0];
                for (std::size_t i = 1; i < reading.facets.size(); ++i) {
                    const int f = reading.facets[i];
                    const double sign = reading.kind == ReadingKind::coplanar ||
                                                glm::dot(shape.normals[f], shape.normals[first]) > 0
                                            ? 1
                                            : -1;
                    for (const Vec3& t : tangents(shape.normals[first])) {
                        put(normal_difference(f, first, sign, t), 0);
                    }
                    if (reading.kind == ReadingKind::coplanar) {
                        put(offset_difference(f, first, sign), 0);
                    }
                }
                break;
            }
            case ReadingKind::rotation:
            case ReadingKind::mirror: {
                base.role = Equation::Role::relation;
                const double angle = reading.order > 0 ? radians(360.0 / reading.order) : 0;
                const int extra = first_extra_[r];
                const MirrorPlane plane{reading.has_direction ? -1 : extra + 1, extra,
                                        reading.azimuth};
                // Within sigma: directions each with an error of its own, distances each by its
                // image's, so that a round girdle may be slowly out of round.
                const bool is_loose = reading.kind == ReadingKind::rotation && !reading.exact;
                if (is_loose) {
                    for (const std::vector<int>& orbit : orbits_of_pairs(pairs_[r])) {
                        for (Formula& contrast : turn_contrasts(mesh_shape_, orbit, angle)) {
                            put(std::move(contrast), 0);
                        }
                    }
                }
                for (const auto& [f, g] : pairs_[r]) {
                    // Two facets, each with an error of its own, differ by more.
                    if (!reading.exact) {
                        base.sigma = (f == g ? 1 : std::numbers::sqrt2) * reading.sigma / unit;
                    }
                    if (is_loose && f != g) {
                        put(turned_height(corners_of(*mesh_outline_, f), g, angle, extra), 0);
                        continue;
                    }
                    if (reading.kind == ReadingKind::mirror && f == g) {
                        if (f != up_facet_) put(across_mirror(f, plane), 0);
                        continue;
                    }
                    if (f == g) {
                        // Only a level facet is its own image in a turn.
                        for (int k = 0; k < 2 && f != up_facet_; ++k) {
                            put(horizontal_component(f, k), 0);
                        }
                        continue;
                    }
                    for (const Vec3& t : tangents(shape.normals[g])) {
                        put(reading.kind == ReadingKind::rotation ? turned_normal(f, g, angle, t)
                                                                  : mirrored_normal(f, g, plane, t),
                            0);
                    }
                    put(reading.kind == ReadingKind::rotation
                            ? turned_height(corners_of(*mesh_outline_, f), g, angle, extra)
                            : mirrored_height(corners_of(*mesh_outline_, f), g, plane),
                        0);
                }
                break;
            }
        }
    }
    std::vector<Equation> expected = expected_equations();
    std::move(expected.begin(), expected.end(), std::back_inserter(all));
    return all;
}

std::vector<Equation> System::hinges() const {
    std::vector<Equation> all;
    if (!stone_.convex) return all;
    for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
        const std::vector<int>& own = solid_.facets[f].corners;
        std::vector<int> near;
        for (int corner : own) {
            for (int g : edges_.facets_of_vertex[corner]) {
                for (int c : solid_.facets[g].corners) near.push_back(c);
            }
        }
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        for (int c : near) {
            if (std::find(own.begin(), own.end(), c) != own.end()) continue;
            Equation e;
            e.role = Equation::Role::hinge;
            e.formula = height(static_cast<int>(f), Corner{c, {-1, -1, -1}});
            all.push_back(std::move(e));
        }
    }
    return all;
}

std::vector<Equation> System::priors() const {
    std::vector<Equation> all;
    for (std::size_t p = 0; p < mesh_shape_.points.size(); ++p) {
        for (int k = 0; k < 3; ++k) {
            Vec3 direction(0);
            direction[k] = 1;
            Equation e;
            e.role = Equation::Role::prior;
            e.sigma = k_mesh_sigma;
            e.formula = point_component(static_cast<int>(p), direction, mesh_shape_.points[p][k]);
            all.push_back(std::move(e));
        }
    }
    return all;
}

}  // namespace culet
