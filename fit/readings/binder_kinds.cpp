// The names in `of`, for each kind of reading.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fit/readings/binder.h"
#include "fit/readings/seen_lines.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

// Refuses a side that the mesh contradicts; hand-made meshes may be off by tens of degrees.
void Binder::refuse_side_of_mesh(const Reading& reading, int f) const {
    constexpr double k_far_deg = 45;
    if (reading.side == 0) return;
    const Vec3& n = stone_.solid.facets[std::size_t(f)].plane.normal;
    const double drawn = degrees(std::acos(std::clamp(glm::dot(n, up_), -1.0, 1.0)));
    const double read = reading.side > 0 ? degrees(reading.value) : 180 - degrees(reading.value);
    if (std::abs(read - drawn) < k_far_deg) return;
    // A girdle facet read slightly over 90 degrees: no side was meant.
    if (written_->side.empty() && 90 - degrees(reading.value) < k_over_upright_deg) return;
    if (written_->side.empty()) refuse_inclination(*written_->value);
    fail(fmt::format("{} is on the {} in the mesh, not on the {}", facet_name(f),
                     drawn < 90 ? "crown" : "pavilion", written_->side));
}

std::vector<Reading> Binder::of_one_facet(const Reading& base) const {
    need_names(1, "one facet");
    const NamedFacets named = facets(written_->of[0]);
    std::vector<Reading> readings;
    const bool spread = named.aggregate == Aggregate::single && named.is_pattern;
    if (named.aggregate != Aggregate::single && base.kind == ReadingKind::azimuth) {
        fail("azimuths have no mean, min or max; name one facet");
    }
    if (named.aggregate == Aggregate::single && !spread && named.facets.size() != 1) {
        fail("names several facets; write one reading for each, a pattern, or mean()");
    }
    const auto check_facet = [&](int f) {
        refuse_side_of_mesh(base, f);
        if (base.kind != ReadingKind::azimuth) return;
        if (facet_name(f) == stone_.up_facet) {
            fail("the facet that `up` names has no azimuth");
        }
    };
    if (!spread) {
        Reading reading = base;
        reading.of = written_->of;
        reading.aggregate = named.aggregate;
        reading.facets = named.facets;
        for (int f : named.facets) check_facet(f);
        return {reading};
    }
    for (int f : named.facets) {
        // A pattern means only facets that can be read so.
        if (base.kind == ReadingKind::azimuth && facet_name(f) == stone_.up_facet) continue;
        Reading reading = base;
        reading.id = base.id + "." + facet_name(f);
        reading.of = {facet_name(f)};
        reading.facets = {f};
        readings.push_back(std::move(reading));
    }
    return readings;
}

std::vector<Reading> Binder::of_two_facets(const Reading& base) const {
    need_names(2, "two facets, such as T/S1");
    const NamedFacets first = facets(written_->of[0]), second = facets(written_->of[1]);
    const bool spread = (first.is_pattern && first.aggregate == Aggregate::single) ||
                        (second.is_pattern && second.aggregate == Aggregate::single);
    if (first.aggregate != Aggregate::single && second.aggregate != Aggregate::single) {
        fail("only one of the two names may be mean(), min() or max()");
    }
    const Aggregate aggregate =
        first.aggregate != Aggregate::single ? first.aggregate : second.aggregate;
    std::vector<Reading> readings;
    Reading shared = base;
    shared.of = written_->of;
    shared.aggregate = aggregate;
    for (int a : first.facets) {
        for (int b : second.facets) {
            const bool several = first.facets.size() > 1 || second.facets.size() > 1;
            // A pattern means only pairs that share an edge.
            if (several && (a == b || !share_edge(stone_.solid, a, b))) continue;
            need_edge(a, b);
            if (spread) {
                Reading reading = base;
                reading.id = fmt::format("{}.{}.{}", base.id, facet_name(a), facet_name(b));
                reading.of = {facet_name(a), facet_name(b)};
                reading.facets = {a, b};
                readings.push_back(std::move(reading));
            } else {
                shared.facets.push_back(a);
                shared.facets.push_back(b);
            }
        }
    }
    if (!spread && !shared.facets.empty()) readings.push_back(std::move(shared));
    if (readings.empty()) fail("no two of the named facets share an edge in the mesh");
    return readings;
}

Reading Binder::of_two_places(const Reading& base) const {
    need_names(2, "two of facet, vertex (v0, v1, ...) and edge (A|B)");
    Reading reading = base;
    reading.of = written_->of;
    reading.places = {place(written_->of[0]), place(written_->of[1])};
    const Place &a = reading.places[0], &b = reading.places[1];
    if (a.kind == b.kind && a.facet == b.facet && a.other_facet == b.other_facet &&
        a.vertex == b.vertex) {
        fail("names the same thing twice");
    }
    if (a.kind == Place::Kind::facet && b.kind == Place::Kind::facet) {
        const Vec3 &m = stone_.solid.facets[a.facet].plane.normal,
                   &n = stone_.solid.facets[b.facet].plane.normal;
        // A rough mesh does not show what is parallel.
        const bool rough = planarity(stone_.solid) > 0.01 * diameter(stone_.solid);
        if (!rough && glm::length(glm::cross(m, n)) > 0.35) {
            fail(
                fmt::format("facets '{}' and '{}' are not parallel in the mesh (they stand {:.0f} "
                            "degrees apart); name a vertex or an edge instead",
                            written_->of[0], written_->of[1],
                            degrees(std::acos(std::min(1.0, std::abs(glm::dot(m, n)))))));
        }
    }
    return reading;
}

Reading Binder::along_direction(const Reading& base) const {
    Reading reading = base;
    reading.of = written_->of;
    std::vector<double> numbers;
    for (const std::string& name : written_->of) {
        std::size_t begin = 0;
        while ((begin = name.find_first_not_of(" \t", begin)) != std::string::npos) {
            const std::size_t end = std::min(name.find_first_of(" \t", begin), name.size());
            const auto number = plain_number(std::string_view(name).substr(begin, end - begin));
            if (!number) {
                fail(
                    fmt::format("`of` is '{}'; expected an azimuth in degrees (45) or a vector "
                                "(1 0 0)",
                                name));
            }
            numbers.push_back(*number);
            begin = end;
        }
    }
    if (numbers.size() == 1) {
        if (std::abs(numbers[0]) > 360) fail("the azimuth in `of` is outside -360..360");
        reading.azimuth = radians(numbers[0]);
    } else if (numbers.size() == 3 && base.kind == ReadingKind::width) {
        const Vec3 direction{numbers[0], numbers[1], numbers[2]};
        const double length = glm::length(direction);
        if (!(length > 0) || !std::isfinite(length)) fail("the vector in `of` has no direction");
        reading.direction = turn_upright(stone_.file_up) * (direction / length);
        reading.has_direction = true;
    } else {
        fail(
            base.kind == ReadingKind::width
                ? "expected an azimuth in degrees (45) or a vector (1 0 0) in `of`; the width of a "
                  "round stone in no particular direction is a `diameter`"
                : "expected an azimuth in degrees in `of`");
    }
    if (base.kind == ReadingKind::table_width && stone_.up_facet.empty()) {
        fail("needs to know the table: set `up` of [stone] to its facet name");
    }
    return reading;
}

Reading Binder::of_whole_stone(const Reading& base) const {
    if (!written_->of.empty()) fail("is of the whole stone; leave `of` empty");
    if (base.kind == ReadingKind::weight && !stone_.material.density_g_cm3) {
        fail("needs the density: give `density` in [stone] or a material that has one");
    }
    return base;
}

Reading Binder::of_many_facets(const Reading& base) const {
    Reading reading = base;
    std::set<int> seen;
    for (const std::string& name : written_->of) {
        const NamedFacets named = facets(name);
        if (named.aggregate != Aggregate::single) fail("takes no mean, min or max");
        for (int f : named.facets) {
            if (!seen.insert(f).second) fail(fmt::format("names facet '{}' twice", facet_name(f)));
            reading.facets.push_back(f);
            reading.of.push_back(facet_name(f));
        }
    }
    const std::size_t least = base.kind == ReadingKind::meet ? 3 : 2;
    if (reading.facets.size() < least) {
        fail(fmt::format("names {} facets; expected {} or more", reading.facets.size(), least));
    }
    return reading;
}

Reading Binder::of_symmetry(const Reading& base) const {
    Reading reading = base;
    reading.of = written_->of;
    std::size_t begin = 0;
    const auto number = written_->of.empty() ? std::nullopt : plain_number(written_->of.front());
    if (base.kind == ReadingKind::rotation) {
        if (!number || *number != std::floor(*number) || *number < 2 || *number > 1000) {
            fail("expected the order first in `of`: a whole number from 2, such as 8");
        }
        reading.order = static_cast<int>(*number);
        begin = 1;
    } else if (number) {
        reading.azimuth = radians(*number);
        reading.has_direction = true;
        begin = 1;
    }
    for (std::size_t i = begin; i < written_->of.size(); ++i) {
        const NamedFacets named = facets(written_->of[i]);
        if (named.aggregate != Aggregate::single) fail("takes no mean, min or max");
        reading.facets.insert(reading.facets.end(), named.facets.begin(), named.facets.end());
    }
    if (base.kind == ReadingKind::mirror && !number) {
        if (reading.facets.empty() || reading.facets.size() % 2 != 0) {
            fail("expected the azimuth of the plane's normal, or facets in pairs, in `of`");
        }
    } else {
        std::set<int> seen;
        for (int f : reading.facets) {
            if (!seen.insert(f).second) fail(fmt::format("names facet '{}' twice", facet_name(f)));
        }
    }
    return reading;
}

Reading Binder::of_line(const Reading& base) const {
    need_names(2, "the two facets of an edge, such as [\"T\", \"C1\"]");
    Reading reading = base;
    reading.of = written_->of;
    reading.facets = {facet(written_->of[0]), facet(written_->of[1])};
    need_edge(reading.facets[0], reading.facets[1]);
    reading.seen_line = written_->seen_line;
    const SeenLine& line = *reading.seen_line;
    reading.sigma /= std::sqrt(double(line.points.size()));
    const glm::dmat4x3& p = line.projection;
    const auto ends = common_corners(stone_.solid, reading.facets[0], reading.facets[1]);
    double squares = 0;
    for (const int end : ends) {
        const Vec3 seen = p * glm::dvec4(stone_.solid.vertices[std::size_t(end)], 1);
        if (!(seen.z > 0)) {
            fail(fmt::format("the edge lies behind the eye: the projection's third row gives {:g}",
                             seen.z));
        }
        // The picture's slopes by the place.
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 2; ++r) {
                squares += std::pow((p[c][r] - seen[r] / seen.z * p[c][2]) / seen.z, 2);
            }
        }
    }
    reading.pixels = std::sqrt(0.5 * squares / double(ends.size()));
    if (!(reading.pixels > 0)) fail("the projection shows every place at one pixel");
    return reading;
}

}  // namespace culet
