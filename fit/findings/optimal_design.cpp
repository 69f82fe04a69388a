#include "fit/findings/optimal_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "fit/model/facet_functions.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

constexpr std::size_t k_tried = 80;  // of the most uncertain candidates, in full
constexpr std::size_t k_told = 5;
constexpr std::size_t k_most_edges = 600;
// Supposed when no reading like it was made.
constexpr double k_angle_sigma_deg = 0.1, k_length_sigma = 0.002, k_volume_sigma = 0.002;

struct Candidate {
    NextReading reading;
    FunctionRow function;
    double sigma = 0;   // inside
    std::string group;  // kind and tier
    double variance = 0, promise = 0;
};

// 0 where readings say so little that the variance is no number: an order needs numbers.
double promise_of(const Candidate& c) {
    const double squares = c.function.squaredNorm();
    if (!std::isfinite(c.variance) || !(c.variance > 0) || !(squares > 0)) return 0.0;
    return c.variance * (c.variance / (c.sigma * c.sigma + c.variance)) / squares;
}

std::string tier_of(const std::string& name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    return last == std::string::npos ? std::string() : name.substr(0, last + 1);
}

// Inside the fit.
double usual_sigma(const System& system, std::initializer_list<ReadingKind> kinds, double none) {
    std::vector<double> sigmas;
    for (const Reading& r : system.readings()) {
        if (r.exact || !(r.sigma > 0)) continue;
        if (std::find(kinds.begin(), kinds.end(), r.kind) == kinds.end()) continue;
        sigmas.push_back(r.sigma / system.unit_of(r));
    }
    if (sigmas.empty()) return none;
    return upper_median(std::move(sigmas));
}

std::vector<Candidate> candidates(const System& system, const Shape& shape,
                                  const Outline& outline) {
    using Kind = ReadingKind;
    std::vector<Candidate> all;
    const RowWriter writer(shape);
    const std::vector<Facet>& facets = system.stone().solid.facets;
    const std::vector<Edge>& edges = system.edges().edges;
    all.reserve(2 * (facets.size() + edges.size()) + shape.points.size() + 40);
    std::set<Kind> has_tool{Kind::inclination, Kind::azimuth, Kind::width, Kind::depth,
                            Kind::table_width, Kind::weight,  Kind::volume};
    for (const Reading& r : system.readings()) has_tool.insert(r.kind);
    // Whoever has read most of the stone may have a microscope with a scale; at the bench nobody
    // has.
    if (!system.has_prior()) has_tool.insert(Kind::edge);
    const auto put = [&](Kind kind, std::vector<std::string> of, const std::string& group,
                         const Formula& formula, double sigma, double unit) {
        if (has_tool.count(kind) == 0) return;
        Candidate c;
        c.reading.kind = kind;
        c.reading.of = std::move(of);
        c.reading.sigma = sigma * unit;
        c.sigma = sigma;
        c.group = std::string(name_of(kind)) + " " + group;
        c.function = writer.function(formula(shape));
        all.push_back(std::move(c));
    };
    const double angle = radians(k_angle_sigma_deg);
    const double tilt = usual_sigma(system, {Kind::inclination}, angle),
                 turn = usual_sigma(system, {Kind::azimuth}, angle),
                 between = usual_sigma(system, {Kind::dihedral}, angle),
                 overall = usual_sigma(system, {Kind::width, Kind::depth, Kind::table_width},
                                       k_length_sigma),
                 edge = usual_sigma(system, {Kind::edge, Kind::distance}, overall);
    const double scale = system.scale();
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (int(f) == system.up_facet()) continue;
        const Vec3& n = shape.normals[f];
        if (std::hypot(n.x, n.y) < 1e-6) continue;
        const std::string& name = facets[f].name;
        put(Kind::inclination, {name}, tier_of(name), tilt_from_up(int(f)), tilt, 1);
        put(Kind::azimuth, {name}, tier_of(name), azimuth_error(int(f), -1, std::atan2(n.y, n.x)),
            turn, 1);
    }
    // Of a large stone some edges: each costs solutions of its own.
    for (std::size_t at = 0; at < edges.size(); at += 1 + edges.size() / k_most_edges) {
        const Edge& e = edges[at];
        if (e.left < 0 || e.right < 0) continue;
        const std::vector<std::string> of{facets[std::size_t(e.left)].name,
                                          facets[std::size_t(e.right)].name};
        std::string tiers = std::min(tier_of(of[0]), tier_of(of[1])) + "/" +
                            std::max(tier_of(of[0]), tier_of(of[1]));
        if (!system.splits()) {
            put(Kind::edge, of, tiers,
                corner_distance(Corner{e.from, {-1, -1, -1}}, Corner{e.to, {-1, -1, -1}}), edge,
                scale);
        }
        put(Kind::dihedral, of, tiers, interior_angle(e.left, e.right), between, 1);
    }
    std::set<int> used;
    for (const auto& loop : outline.loops) used.insert(loop.begin(), loop.end());
    const auto extent_along = [&](const std::vector<int>& corners, const Vec3& direction) {
        const auto order = [&](int a, int b) {
            return glm::dot(direction, place_of(shape, outline.corners[std::size_t(a)])) <
                   glm::dot(direction, place_of(shape, outline.corners[std::size_t(b)]));
        };
        return extent(
            outline.corners[std::size_t(*std::max_element(corners.begin(), corners.end(), order))],
            outline.corners[std::size_t(*std::min_element(corners.begin(), corners.end(), order))],
            direction);
    };
    const std::vector<int> corners(used.begin(), used.end());
    if (corners.empty()) return all;
    put(Kind::depth, {}, "", extent_along(corners, {0, 0, 1}), overall, scale);
    const int up = system.up_facet();
    for (int k = 0; k < 16; ++k) {
        const double azimuth_deg = 11.25 * k;
        const Vec3 direction{std::cos(radians(azimuth_deg)), std::sin(radians(azimuth_deg)), 0};
        const std::string of = fmt::format("{:g}", azimuth_deg);
        put(Kind::width, {of}, "", extent_along(corners, direction), overall, scale);
        if (up >= 0 && outline.loops[std::size_t(up)].size() >= 3) {
            put(Kind::table_width, {of}, "",
                extent_along(outline.loops[std::size_t(up)], direction), overall, scale);
        }
    }
    if (up >= 0) {
        // Heights of the table over the corners of the mesh that still are corners; of a large
        // stone over some, since each costs a solution of its own.
        const std::size_t corner_count = system.stone().solid.vertices.size();
        for (std::size_t v = 0; v < corner_count; v += 1 + corner_count / 200) {
            const std::vector<int>& own = system.edges().facets_of_vertex[v];
            if (system.splits() || std::find(own.begin(), own.end(), up) != own.end()) continue;
            std::set<std::string> tiers;
            for (const int f : own) tiers.insert(tier_of(facets[std::size_t(f)].name));
            std::string group;
            for (const std::string& tier : tiers) group += tier + ",";
            put(Kind::distance, {facets[std::size_t(up)].name, fmt::format("v{}", v)}, group,
                height(up, Corner{int(v), {-1, -1, -1}}), overall, scale);
        }
    }
    const auto mesh_outline = std::make_shared<const Outline>(outline);
    const Formula volume = enclosed_volume(mesh_outline);
    const double value = volume(shape).value;
    const bool has_density = system.stone().material.density_g_cm3.has_value();
    Reading whole;
    whole.kind = has_density ? Kind::weight : Kind::volume;
    const double usual = usual_sigma(system, {Kind::weight, Kind::volume}, k_volume_sigma * value);
    put(whole.kind, {}, "", volume, usual, system.unit_of(whole));
    return all;
}

// Their places in the order of a value, the largest first. They are large, and stay where they are.
template <typename Value>
std::vector<std::size_t> by_falling(const std::vector<Candidate>& candidates, const Value& value) {
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return value(candidates[a]) > value(candidates[b]);
    });
    return order;
}

// Sums of squared covariances of each candidate with all parts of the total.
Eigen::VectorXd drops_of(const DenseRows& halves, const std::vector<Candidate>& tried,
                         const Covariance& covariance) {
    std::vector<FunctionRow> functions;
    for (const Candidate& c : tried) functions.push_back(c.function);
    const Eigen::MatrixXd across = halves * covariance.halves(functions)->transpose();
    return across.colwise().squaredNorm();
}

// Likewise from solutions of large equations.
Eigen::VectorXd drops_one_by_one(const Shape& shape, const Vec3& middle,
                                 const std::vector<Candidate>& tried,
                                 const Covariance& covariance) {
    const Layout layout = layout_of(shape);
    Eigen::VectorXd drops = Eigen::VectorXd::Zero(Eigen::Index(tried.size()));
    for (std::size_t i = 0; i < tried.size(); ++i) {
        const Eigen::VectorXd with = covariance.with_all(tried[i].function, true);
        for (int f = 0; f < layout.facets; ++f) {
            const auto [t, u] = tangents(shape.normals[std::size_t(f)]);
            const double a = with(layout.tilt(f)), b = with(layout.tilt(f) + 1);
            const double o = with(layout.offset(f)) - glm::dot(middle, a * t + b * u);
            drops(Eigen::Index(i)) += a * a + b * b + o * o;
        }
    }
    return drops;
}

}  // namespace

std::vector<NextReading> next_readings(const System& system, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance) {
    const Layout layout = layout_of(shape);
    const Vec3 middle = middle_of(shape);
    // Functions whose variances add up to the total.
    std::vector<FunctionRow> parts;
    for (int f = 0; f < layout.facets; ++f) {
        for (int k = 0; k < 2; ++k) {
            FunctionRow row(layout.size());
            row.coeffRef(layout.tilt(f) + k) = 1;
            parts.push_back(std::move(row));
        }
        parts.push_back(facet_functions(shape, f, layout, middle)[2]);
    }
    const std::optional<DenseRows> halves = covariance.halves(parts);
    double total = 0;
    if (halves) {
        total = halves->squaredNorm();
    } else {
        for (const FunctionRow& row : parts) total += covariance.total_variance(row);
    }
    if (!(total > 0) || !std::isfinite(total)) return {};
    std::vector<Candidate> all = candidates(system, shape, *outline);
    for (Candidate& c : all) {
        c.variance = covariance.total_variance(c.function);
        c.promise = promise_of(c);
    }
    // The most uncertain, but some of every kind and tier: their reach differs.
    std::vector<Candidate> tried;
    tried.reserve(k_tried);
    std::map<std::string, int> of_group;
    for (const std::size_t i : by_falling(all, [](const Candidate& c) { return c.promise; })) {
        if (tried.size() >= k_tried) break;
        if (++of_group[all[i].group] <= 2 && all[i].promise > 0) tried.push_back(all[i]);
    }
    const Eigen::VectorXd drops = halves ? drops_of(*halves, tried, covariance)
                                         : drops_one_by_one(shape, middle, tried, covariance);
    for (std::size_t i = 0; i < tried.size(); ++i) {
        Candidate& c = tried[i];
        const double drop = drops(Eigen::Index(i));
        const double share = drop / (c.sigma * c.sigma + c.variance) / total;
        c.reading.reduces = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
        // Tighter than what the mesh says, where only the mesh said something.
        c.reading.closes = covariance.rank_defect() > 0 &&
                           covariance.open_variance(c.function) > 4 * c.sigma * c.sigma &&
                           covariance.open_variance(c.function) > 0.5 * c.variance;
    }
    std::vector<NextReading> best;
    std::set<std::string> told;
    for (const std::size_t i :
         by_falling(tried, [](const Candidate& c) { return c.reading.reduces; })) {
        const Candidate& c = tried[i];
        if (best.size() == k_told || !(c.reading.reduces > 1e-6)) break;
        if (told.insert(c.group).second) best.push_back(c.reading);
    }
    return best;
}

}  // namespace culet
