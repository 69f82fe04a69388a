// ReadAngles beside those of their tier and of the mesh.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "fit/findings/first_check_parts.h"
#include "fit/readings/named_tiers.h"
#include "stone/tiers.h"

namespace culet {

namespace {

// How much facets of one tier, and a tier and its design, honestly differ.
constexpr double k_sisters_deg = 0.3, k_from_mesh_deg = 1, k_from_drawing_deg = 3;
constexpr std::size_t k_fewest_azimuths = 4;
constexpr double k_no_azimuth_deg = 5;

bool is_of_one_facet(const Reading& r, ReadingKind kind) {
    return r.kind == kind && r.aggregate == Aggregate::single && r.facets.size() == 1 &&
           r.datum.kind == Datum::Kind::up && !r.exact;
}

// How far inclinations of this mesh are off, tiers' own differences and all: a design's tiers by a
// degree, a drawing by hand by more.
double mesh_sigma(const std::vector<ReadAngle>& all, bool is_design) {
    std::vector<double> off;
    for (const ReadAngle& a : all) off.push_back(a.off());
    return std::max(radians(is_design ? k_from_mesh_deg : k_from_drawing_deg), robust_sigma(off));
}

Expected expected_of(const ReadAngle& own, const std::vector<const ReadAngle*>& sisters,
                     double from_mesh) {
    // Two that differ do not say which of them is wrong.
    constexpr std::size_t k_fewest_sisters = 2;
    if (sisters.size() < k_fewest_sisters) {
        return {own.mesh, from_mesh, fmt::format("the mesh ({:.1f})", degrees(own.mesh))};
    }
    std::vector<double> values, off;
    for (const ReadAngle* a : sisters) {
        values.push_back(a->row.value);
        off.push_back(a->off());
    }
    Expected expected = expected_of_sisters(own.row, own.mesh, values, off, radians(k_sisters_deg));
    expected.by = fmt::format("its {} {} ({})", count_words(values.size()),
                              values.size() == 1 ? "sister" : "sisters", range_of(values));
    return expected;
}

void check_inclinations(const Stone& stone, const std::vector<Reading>& readings, const Vec3& up,
                        bool is_design, std::vector<Doubt>& doubts) {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const Reading& r = readings[i];
        const bool is_mean = r.kind == ReadingKind::inclination && !r.facets.empty() && !r.exact &&
                             r.aggregate == Aggregate::mean && r.datum.kind == Datum::Kind::up;
        if (is_mean || is_of_one_facet(r, ReadingKind::inclination)) asked.push_back(i);
    }
    std::vector<ReadAngle> all, means;
    for (Row& row : rows_of(readings, asked)) {
        const Reading& r = readings[row.readings.front()];
        double mesh = 0;
        for (const int f : r.facets) {
            mesh += inclination(stone.solid.facets[std::size_t(f)].plane.normal, up) /
                    double(r.facets.size());
        }
        (r.aggregate == Aggregate::mean ? means : all)
            .push_back({std::move(row), r.facets[0], mesh});
    }
    const std::vector<NamedTier> tiers = named_tiers(stone.solid, up);
    const std::vector<int> tier_of = tier_of_each(tiers, stone.solid.facets.size());
    const double from_mesh = mesh_sigma(all, is_design);
    for (const ReadAngle& own : all) {
        const int tier = tier_of[std::size_t(own.facet)];
        std::vector<const ReadAngle*> sisters;
        for (const ReadAngle& other : all) {
            if (&other != &own && tier >= 0 && tier_of[std::size_t(other.facet)] == tier &&
                other.facet != own.facet) {
                sisters.push_back(&other);
            }
        }
        doubt_if_far(readings, own.row, expected_of(own, sisters, from_mesh), doubts);
    }
    // A mean has no sisters.
    for (const ReadAngle& own : means) {
        doubt_if_far(readings, own.row, expected_of(own, {}, from_mesh), doubts);
    }
    all.insert(all.end(), means.begin(), means.end());
    check_tiers(readings, all, tier_of, tiers,
                radians(is_design ? k_from_mesh_deg : k_from_drawing_deg), doubts);
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

// The turn that most azimuths agree on, and how well: each one's own turn is tried.
struct Turn {
    double angle = 0, sigma = std::numeric_limits<double>::infinity();
};
Turn common_turn(const std::vector<double>& turns) {
    Turn best;
    for (const double t : turns) {
        std::vector<double> off;
        for (const double other : turns) off.push_back(wrapped(other - t));
        const double sigma = robust_sigma(off);
        if (sigma < best.sigma) best = {t + median(off), sigma};
    }
    return best;
}

void check_azimuths(const Stone& stone, const std::vector<Reading>& readings, const Vec3& up,
                    std::vector<Doubt>& doubts) {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!is_of_one_facet(readings[i], ReadingKind::azimuth)) continue;
        // A level facet has none.
        const Vec3& n = stone.solid.facets[std::size_t(readings[i].facets[0])].plane.normal;
        if (inclination(n, up) > radians(k_no_azimuth_deg)) asked.push_back(i);
    }
    if (asked.size() < k_fewest_azimuths) return;
    // Counted as drawn, or the other way round (a mesh drawn as its mirror image).
    std::array<std::vector<double>, 2> turns;
    for (const std::size_t i : asked) {
        const Vec3& n = stone.solid.facets[std::size_t(readings[i].facets[0])].plane.normal;
        const double drawn = azimuth(n);
        turns[0].push_back(readings[i].value - drawn);
        turns[1].push_back(readings[i].value + drawn);
    }
    const std::array<Turn, 2> common{common_turn(turns[0]), common_turn(turns[1])};
    const std::size_t way = common[1].sigma < common[0].sigma ? 1 : 0;
    constexpr double k_no_agreement_deg = 10;
    if (!(common[way].sigma < radians(k_no_agreement_deg))) return;
    const double sigma = std::max(radians(k_from_mesh_deg), common[way].sigma);
    for (std::size_t k = 0; k < asked.size(); ++k) {
        const Reading& r = readings[asked[k]];
        const double off = wrapped(turns[way][k] - common[way].angle);
        const double expected = r.value - off;
        doubt_if_far(
            readings, {{asked[k]}, r.value, r.sigma},
            {expected, sigma,
             fmt::format("where the other azimuths put this facet ({:.1f})", degrees(expected))},
            doubts);
    }
}

}  // namespace

std::string count_words(std::size_t n) {
    static constexpr std::array<const char*, 13> words{"no",   "one",    "two",   "three", "four",
                                                       "five", "six",    "seven", "eight", "nine",
                                                       "ten",  "eleven", "twelve"};
    return n < words.size() ? words[n] : std::to_string(n);
}

std::string range_of(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const std::string low = fmt::format("{:.1f}", degrees(*least)),
                      high = fmt::format("{:.1f}", degrees(*most));
    return low == high ? low : low + " to " + high;
}

void check_angles(const Stone& stone, const std::vector<Reading>& readings, bool is_design,
                  std::vector<Doubt>& doubts) {
    const int table = find_facet(stone.solid, stone.up_facet);
    const Vec3 up =
        table >= 0 ? stone.solid.facets[std::size_t(table)].plane.normal : glm::normalize(stone.up);
    check_inclinations(stone, readings, up, is_design, doubts);
    check_azimuths(stone, readings, up, doubts);
}

}  // namespace culet
