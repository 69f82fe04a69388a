#include "fit/findings/candidate_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "stone/tiers.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

using Kind = ReadingKind;

// Of a large stone about so many edges and corners are tried: each costs solutions of its own.
constexpr std::size_t k_most_edges = 600, k_most_corners = 200;
// Directions of widths, over half a turn.
constexpr int k_directions = 16;
// Supposed when no reading like it was made.
constexpr double k_angle_sigma_deg = 0.1, k_length_sigma = 0.002, k_volume_sigma = 0.002;

// Inside the fit.
double usual_sigma(const System& system, std::initializer_list<Kind> kinds, double none) {
    std::vector<double> sigmas;
    for (const Reading& r : system.readings()) {
        if (r.exact || !(r.sigma > 0)) continue;
        if (std::find(kinds.begin(), kinds.end(), r.kind) == kinds.end()) continue;
        sigmas.push_back(r.sigma / system.unit_of(r));
    }
    if (sigmas.empty()) return none;
    return upper_median(std::move(sigmas));
}

// Kinds that whoever made these readings can make.
std::set<Kind> tools_at_hand(const System& system) {
    std::set<Kind> tools{Kind::inclination, Kind::azimuth, Kind::width, Kind::depth,
                         Kind::table_width, Kind::weight,  Kind::volume};
    for (const Reading& r : system.readings()) tools.insert(r.kind);
    // Whoever has read most of the stone may have a microscope with a scale; at the bench nobody
    // has.
    if (!system.has_prior()) tools.insert(Kind::edge);
    return tools;
}

class CandidateList {
public:
    CandidateList(const System& system, const Shape& shape,
                  const std::shared_ptr<const Outline>& outline)
        : system_(system),
          shape_(shape),
          outline_(outline),
          writer_(shape),
          tools_(tools_at_hand(system)),
          length_sigma_(
              usual_sigma(system, {Kind::width, Kind::depth, Kind::table_width}, k_length_sigma)) {
        const Solid& solid = system.stone().solid;
        for (const int t : tier_of_each(tiers_of(solid, system.stone().up), solid.facets.size()))
            tier_of_.push_back(std::to_string(t));
        // They are large, and stay where they are.
        all_.reserve(2 * (facets().size() + system.edges().edges.size()) + shape.points.size() +
                     40);
    }

    void add_facet_angles();
    void add_edges();
    void add_widths_and_depth();
    void add_heights_of_table();
    void add_size();
    std::vector<CandidateReading> take() { return std::move(all_); }

private:
    const std::vector<Facet>& facets() const { return system_.stone().solid.facets; }
    Formula extent_along(const std::vector<int>& corners, const Vec3& direction) const;
    void put(Kind kind, std::vector<std::string> of, const std::string& group,
             const Formula& formula, double sigma, double unit);
    void put_length(Kind kind, std::vector<std::string> of, const std::string& group,
                    const Formula& formula) {
        put(kind, std::move(of), group, formula, length_sigma_, system_.scale());
    }

    const System& system_;
    const Shape& shape_;
    const std::shared_ptr<const Outline>& outline_;
    RowWriter writer_;
    std::set<Kind> tools_;
    std::vector<std::string> tier_of_;  ///< of each facet, by the form
    double length_sigma_;
    std::vector<CandidateReading> all_;
};

void CandidateList::put(Kind kind, std::vector<std::string> of, const std::string& group,
                        const Formula& formula, double sigma, double unit) {
    if (tools_.count(kind) == 0) return;
    CandidateReading c;
    c.reading.kind = kind;
    c.reading.of = std::move(of);
    c.reading.sigma = sigma * unit;
    c.sigma = sigma;
    c.group = std::string(name_of(kind)) + " " + group;
    c.function = writer_.function(formula(shape_));
    all_.push_back(std::move(c));
}

void CandidateList::add_facet_angles() {
    const double angle = radians(k_angle_sigma_deg);
    const double tilt = usual_sigma(system_, {Kind::inclination}, angle),
                 turn = usual_sigma(system_, {Kind::azimuth}, angle);
    for (std::size_t f = 0; f < facets().size(); ++f) {
        if (int(f) == system_.up_facet()) continue;
        const Vec3& n = shape_.normals[f];
        if (std::hypot(n.x, n.y) < 1e-6) continue;
        const std::string& name = facets()[f].name;
        put(Kind::inclination, {name}, tier_of_[f], tilt_from_up(int(f)), tilt, 1);
        put(Kind::azimuth, {name}, tier_of_[f], azimuth_error(int(f), -1, std::atan2(n.y, n.x)),
            turn, 1);
    }
}

void CandidateList::add_edges() {
    const std::vector<Edge>& edges = system_.edges().edges;
    const double between = usual_sigma(system_, {Kind::dihedral}, radians(k_angle_sigma_deg)),
                 length = usual_sigma(system_, {Kind::edge, Kind::distance}, length_sigma_);
    for (std::size_t at = 0; at < edges.size(); at += 1 + edges.size() / k_most_edges) {
        const Edge& e = edges[at];
        if (e.left < 0 || e.right < 0) continue;
        const std::vector<std::string> of{facets()[std::size_t(e.left)].name,
                                          facets()[std::size_t(e.right)].name};
        const auto [one, other] =
            std::minmax(tier_of_[std::size_t(e.left)], tier_of_[std::size_t(e.right)]);
        const std::string tiers = one + "/" + other;
        if (!system_.splits()) {
            put(Kind::edge, of, tiers,
                corner_distance(Corner{e.from, {-1, -1, -1}}, Corner{e.to, {-1, -1, -1}}), length,
                system_.scale());
        }
        put(Kind::dihedral, of, tiers, interior_angle(e.left, e.right), between, 1);
    }
}

Formula CandidateList::extent_along(const std::vector<int>& corners, const Vec3& direction) const {
    const auto corner = [&](int c) -> const Corner& { return outline_->corners[std::size_t(c)]; };
    const auto order = [&](int a, int b) {
        return glm::dot(direction, place_of(shape_, corner(a))) <
               glm::dot(direction, place_of(shape_, corner(b)));
    };
    return extent(corner(*std::max_element(corners.begin(), corners.end(), order)),
                  corner(*std::min_element(corners.begin(), corners.end(), order)), direction);
}

void CandidateList::add_widths_and_depth() {
    std::set<int> used;
    for (const auto& loop : outline_->loops) used.insert(loop.begin(), loop.end());
    const std::vector<int> corners(used.begin(), used.end());
    put_length(Kind::depth, {}, "", extent_along(corners, {0, 0, 1}));
    const int up = system_.up_facet();
    for (int k = 0; k < k_directions; ++k) {
        const double azimuth_deg = 180.0 / k_directions * k;
        const Vec3 direction{std::cos(radians(azimuth_deg)), std::sin(radians(azimuth_deg)), 0};
        const std::string of = fmt::format("{:g}", azimuth_deg);
        put_length(Kind::width, {of}, "", extent_along(corners, direction));
        if (up >= 0 && outline_->loops[std::size_t(up)].size() >= 3) {
            put_length(Kind::table_width, {of}, "",
                       extent_along(outline_->loops[std::size_t(up)], direction));
        }
    }
}

// Over the corners of the mesh that still are corners.
void CandidateList::add_heights_of_table() {
    const int up = system_.up_facet();
    if (up < 0 || system_.splits()) return;
    const std::size_t corner_count = system_.stone().solid.vertices.size();
    for (std::size_t v = 0; v < corner_count; v += 1 + corner_count / k_most_corners) {
        const std::vector<int>& own = system_.edges().facets_of_vertex[v];
        if (std::find(own.begin(), own.end(), up) != own.end()) continue;
        std::set<std::string> tiers;
        for (const int f : own) tiers.insert(tier_of_[std::size_t(f)]);
        std::string group;
        for (const std::string& tier : tiers) group += tier + ",";
        put_length(Kind::distance, {facets()[std::size_t(up)].name, fmt::format("v{}", v)}, group,
                   height(up, Corner{int(v), {-1, -1, -1}}));
    }
}

void CandidateList::add_size() {
    const Formula volume = enclosed_volume(outline_);
    Reading whole;
    whole.kind = system_.stone().material.density_g_cm3 ? Kind::weight : Kind::volume;
    const double usual =
        usual_sigma(system_, {Kind::weight, Kind::volume}, k_volume_sigma * volume(shape_).value);
    put(whole.kind, {}, "", volume, usual, system_.unit_of(whole));
}

}  // namespace

std::vector<CandidateReading> candidate_readings(const System& system, const Shape& shape,
                                                 const std::shared_ptr<const Outline>& outline) {
    CandidateList list(system, shape, outline);
    list.add_facet_angles();
    list.add_edges();
    const bool encloses = std::any_of(outline->loops.begin(), outline->loops.end(),
                                      [](const std::vector<int>& loop) { return !loop.empty(); });
    if (encloses) {
        list.add_widths_and_depth();
        list.add_heights_of_table();
        list.add_size();
    }
    return list.take();
}

}  // namespace culet
