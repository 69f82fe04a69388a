#include "tests/fit/cutters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "fit/readings/named_tiers.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "tests/fit/cutter_slips.h"
#include "tests/fit/fit_truth.h"

namespace culet::bench {

namespace {

double normal(Random& random, double sigma) {
    return std::normal_distribution<double>(0, sigma)(random);
}

bool is_step(const std::string& cut) {
    return cut == "step";
}

std::vector<std::string> numbered(const Solid& design, const std::string& letter) {
    std::vector<std::string> names;
    for (int i = 1; find_facet(design, letter + std::to_string(i)) >= 0; ++i) {
        names.push_back(letter + std::to_string(i));
    }
    return names;
}

// The tiers of mains that are read one by one. Two of their facets are made steeper.
std::vector<std::vector<std::string>> main_tiers(const std::string& cut, const Solid& design) {
    std::vector<std::vector<std::string>> tiers;
    if (is_step(cut)) {
        for (const char* tier : {"C1", "C2", "C3", "P1", "P2", "P3"}) {
            tiers.emplace_back();
            for (const char* side : {"E", "N", "W", "S"}) {
                tiers.back().push_back(std::string(tier) + side);
            }
        }
        return tiers;
    }
    for (const char* tier : {"C", "P"}) {
        tiers.emplace_back();
        tiers.back() = numbered(design, tier);
    }
    return tiers;
}

// Tilts a facet about its own centre, as if it were polished a little too steep.
void tilt(Solid& solid, int f, double steeper, double turned, double shift) {
    Facet& facet = solid.facets[std::size_t(f)];
    const Vec3 middle = corner_mean(solid, facet);
    const Vec3& n = facet.plane.normal;
    const double flat = std::hypot(n.x, n.y), side = n.z < 0 ? -1 : 1;
    const double polar = std::atan2(flat, side * n.z) + steeper;
    const double azimuth = std::atan2(n.y, n.x) + turned;
    facet.plane.normal = {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                          side * std::cos(polar)};
    facet.plane.offset = glm::dot(facet.plane.normal, middle) + shift;
}

// The stone as it was cut; nothing if some facet was cut away.
bool cut_stone(const Solid& design, const Population& population,
               const std::vector<std::string>& steep, Random& random, Solid& stone) {
    stone = design;
    const double width = width_along(design, {0, 1, 0});
    std::vector<double> common(design.facets.size(), 0);
    for (const NamedTier& tier : named_tiers(design, {0, 0, 1})) {
        const double off = normal(random, radians(population.tier_deg));
        for (const int f : tier.facets) common[std::size_t(f)] = off;
    }
    for (int f = 0; f < int(design.facets.size()); ++f) {
        const std::string& name = design.facets[std::size_t(f)].name;
        if (name == "T") continue;
        double steeper = normal(random, radians(population.facet_deg)) + common[std::size_t(f)];
        const double turned = normal(random, radians(population.facet_deg));
        const double shift = normal(random, population.offset * width);
        if (std::find(steep.begin(), steep.end(), name) != steep.end()) {
            steeper = radians(population.two_deg) + common[std::size_t(f)];
        }
        if (std::abs(design.facets[std::size_t(f)].plane.normal.z) > 0.999) steeper = 0;
        tilt(stone, f, steeper, turned, shift);
    }
    if (population.meets) return bring_to_meet(stone) && is_convex(stone);
    std::vector<NamedPlane> planes;
    for (const Facet& facet : stone.facets) planes.push_back({facet.name, facet.plane});
    HalfSpaceSolid enclosed = intersect_half_spaces(planes);
    if (!enclosed.unused_planes.empty() || !enclosed.bounded) return false;
    stone = std::move(enclosed.solid);
    return true;
}

class Bench {
public:
    Bench(const Evening& evening, Random& random) : evening_(evening), random_(random) {}

    CutterRow angle(const std::string& facet, const std::string& as, double sigma) {
        const double read = degrees(inclination(plane(facet).normal, {0, 0, 1}));
        return {"inclination",
                {as},
                fmt::format("{:.1f}", std::min(90.0, read + normal(random_, sigma))),
                sigma};
    }
    CutterRow length(const char* kind, std::vector<std::string> of, double true_value) {
        constexpr double k_caliper = 0.01;
        return {kind, std::move(of), fmt::format("{:.2f}", true_value + normal(random_, k_caliper)),
                k_caliper};
    }
    double width(double azimuth_deg) const {
        const double a = radians(azimuth_deg);
        return width_along(evening_.truth, {std::cos(a), std::sin(a), 0});
    }
    double table_width(double azimuth_deg) const {
        const double a = radians(azimuth_deg);
        double low = 1e9, high = -1e9;
        for (const int c : facet("T").corners) {
            const double along = glm::dot(Vec3{std::cos(a), std::sin(a), 0},
                                          evening_.truth.vertices[std::size_t(c)]);
            low = std::min(low, along);
            high = std::max(high, along);
        }
        return high - low;
    }
    double carats() const {
        return carat(volume(evening_.truth), *evening_.design.material.density_g_cm3);
    }

private:
    const Facet& facet(const std::string& name) const {
        return evening_.truth.facets[std::size_t(find_facet(evening_.truth, name))];
    }
    const Plane& plane(const std::string& name) const { return facet(name).plane; }
    const Evening& evening_;
    Random& random_;
};

std::vector<CutterRow> read_rows(const std::string& cut, Evening& evening, Random& random) {
    Bench bench(evening, random);
    constexpr double k_goniometer = 0.1, k_small_facet = 0.5, k_scale = 0.005;
    std::vector<CutterRow> rows;
    std::set<std::string> read;
    for (const std::vector<std::string>& tier : main_tiers(cut, evening.design.solid)) {
        for (const std::string& name : tier) {
            rows.push_back(bench.angle(name, name, k_goniometer));
            read.insert(name);
        }
    }
    if (cut == "round-brilliant") {
        // One facet of each small tier is read and taken for all of them.
        for (const char* tier : {"S", "U", "L", "G"}) {
            rows.push_back(
                bench.angle(tier + std::string("1"), tier + std::string("*"), k_small_facet));
        }
    } else if (!is_step(cut)) {
        for (const std::string& name : numbered(evening.design.solid, "S")) {
            rows.push_back(bench.angle(name, name, k_goniometer));
            read.insert(name);
        }
    }
    for (const Facet& facet : evening.design.solid.facets) {
        evening.was_read.push_back(read.count(facet.name) > 0);
    }
    const bool is_round = cut == "round-brilliant";
    for (const int a : is_round ? std::vector<int>{0, 45, 90, 135} : std::vector<int>{0, 90}) {
        rows.push_back(bench.length("width", {std::to_string(a)}, bench.width(a)));
    }
    rows.push_back(bench.length("depth", {}, width_along(evening.truth, {0, 0, 1})));
    for (const int a : {0, 90}) {
        rows.push_back(bench.length("table_width", {std::to_string(a)}, bench.table_width(a)));
    }
    rows.push_back(
        {"weight", {}, fmt::format("{:.3f}", bench.carats() + normal(random, k_scale)), k_scale});
    return rows;
}

}  // namespace

Evening cutters_evening(const std::string& cut, const Population& population, Slipped slip,
                        std::uint64_t seed) {
    Random random(seed * 2654435761u + std::uint64_t(cut[0]));
    Evening evening;
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::map<std::string, double> proportions;
    if (cut == "round-brilliant") proportions = {{"diameter", within(5, 8)}};
    if (cut == "oval" || cut == "cushion")
        proportions = {{"width", within(5, 8)}, {"ratio", within(1.1, 1.4)}};
    evening.design.solid = make_cut(cut, proportions);
    evening.design.up_facet = "T";
    evening.design.material.density_g_cm3 = 3.52;
    const auto tiers = main_tiers(cut, evening.design.solid);
    const auto& tier = tiers[one_of(random, tiers.size())];
    const std::size_t first = one_of(random, tier.size());
    evening.steep = {tier[first]};
    if (is_step(cut)) {
        // With only two of a step's four sides there would be nothing to compare their steepness
        // with.
        const auto& other = tiers[(std::size_t(&tier - tiers.data()) + 1) % tiers.size()];
        evening.steep.push_back(other[first]);
    } else {
        evening.steep.push_back(tier[(first + 1 + one_of(random, tier.size() - 1)) % tier.size()]);
    }
    while (!cut_stone(evening.design.solid, population, evening.steep, random, evening.truth)) {
    }
    std::vector<CutterRow> rows = read_rows(cut, evening, random);
    const std::vector<std::size_t> wrong = make_slip(rows, slip, random);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        WrittenReading w;
        w.kind = rows[i].kind;
        w.of = rows[i].of;
        w.value = std::stod(rows[i].value);
        w.sigma = rows[i].sigma;
        w.file = "readings.csv";
        w.line = long(i) + 2;
        evening.rows.push_back(std::move(w));
    }
    for (const std::size_t i : wrong) evening.wrong_lines.push_back(long(i) + 2);
    return evening;
}

}  // namespace culet::bench
