#include "fit/findings/candidate_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

using Kind = ReadingKind;

// Of a large stone about so many edges are tried: each costs solutions of its own.
constexpr std::size_t k_most_edges = 600;
// Directions of widths, over half a turn.
constexpr int k_directions = 16;
// Supposed when no reading like it was made: radians, half diameters, and of the volume.
constexpr double k_angle_sigma = radians(0.1), k_length_sigma = 0.002, k_volume_sigma = 0.002;

// Inside the fit; of the readings of some kinds, or else `none`.
double usual_sigma(const FitModel& model, const std::set<Kind>& kinds, double none) {
    std::vector<double> sigmas;
    for (const Reading& r : model.readings()) {
        if (r.exact || !(r.sigma > 0) || kinds.count(r.kind) == 0) continue;
        sigmas.push_back(r.sigma / model.frame().unit_of(r));
    }
    return sigmas.empty() ? none : upper_median(std::move(sigmas));
}

class CandidateList {
public:
    CandidateList(const FitModel& model, const Shape& shape,
                  const std::shared_ptr<const Outline>& outline)
        : model_(model),
          shape_(shape),
          outline_(outline),
          writer_(shape),
          facets_(model.stone().solid.facets) {
        // They are large, and stay where they are.
        all_.reserve(2 * facets_.size() + model.edges().edges.size() + 2 * k_directions + 2);
    }

    void add_facet_angles(const std::vector<int>& tier_of);
    void add_edges(const std::vector<int>& tier_of);
    void add_widths_and_depth();
    void add_size();
    std::vector<CandidateReading> take() { return std::move(all_); }

private:
    Formula extent_along(const std::vector<int>& corners, const Vec3& direction) const;
    // `unit`: of the reading, in that of the fit.
    void put(Kind kind, std::vector<std::string> of, const std::string& group,
             const Formula& formula, double sigma, double unit);

    const FitModel& model_;
    const Shape& shape_;
    const std::shared_ptr<const Outline>& outline_;
    RowWriter writer_;
    const std::vector<Facet>& facets_;
    std::vector<CandidateReading> all_;
};

void CandidateList::put(Kind kind, std::vector<std::string> of, const std::string& group,
                        const Formula& formula, double sigma, double unit) {
    CandidateReading c;
    c.reading.kind = kind;
    c.reading.of = std::move(of);
    c.reading.sigma = sigma * unit;
    c.sigma = sigma;
    c.group = fmt::format("{} {}", name_of(kind), group);
    c.function = writer_.function(formula(shape_));
    all_.push_back(std::move(c));
}

void CandidateList::add_facet_angles(const std::vector<int>& tier_of) {
    const double tilt = usual_sigma(model_, {Kind::inclination}, k_angle_sigma),
                 turn = usual_sigma(model_, {Kind::azimuth}, k_angle_sigma);
    for (std::size_t f = 0; f < facets_.size(); ++f) {
        const Vec3& n = shape_.normals[f];
        if (int(f) == model_.frame().up_facet() || std::hypot(n.x, n.y) < 1e-6) continue;
        const std::string tier = std::to_string(tier_of[f]);
        put(Kind::inclination, {facets_[f].name}, tier, tilt_from_up(int(f)), tilt, 1);
        put(Kind::azimuth, {facets_[f].name}, tier, azimuth_error(int(f), -1, std::atan2(n.y, n.x)),
            turn, 1);
    }
}

// Whoever has read most of the stone may have a microscope with a scale; at the bench nobody has.
void CandidateList::add_edges(const std::vector<int>& tier_of) {
    const bool were_read = std::any_of(model_.readings().begin(), model_.readings().end(),
                                       [](const Reading& r) { return r.kind == Kind::edge; });
    if (model_.meets().splits || (!model_.prior().empty() && !were_read)) return;
    const double sigma = usual_sigma(
        model_, {Kind::edge, Kind::distance},
        usual_sigma(model_, {Kind::width, Kind::depth, Kind::table_width}, k_length_sigma));
    const std::vector<Edge>& edges = model_.edges().edges;
    for (std::size_t at = 0; at < edges.size(); at += 1 + edges.size() / k_most_edges) {
        const Edge& e = edges[at];
        if (e.left < 0 || e.right < 0) continue;
        const auto left = std::size_t(e.left), right = std::size_t(e.right);
        const auto [one, other] = std::minmax(tier_of[left], tier_of[right]);
        put(Kind::edge, {facets_[left].name, facets_[right].name}, fmt::format("{}/{}", one, other),
            corner_distance(Corner{e.from}, Corner{e.to}), sigma, model_.frame().scale());
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
    if (used.empty()) return;
    const std::vector<int> corners(used.begin(), used.end());
    const std::vector<int> table = model_.frame().up_facet() < 0
                                       ? std::vector<int>()
                                       : outline_->loops[std::size_t(model_.frame().up_facet())];
    const double sigma =
        usual_sigma(model_, {Kind::width, Kind::depth, Kind::table_width}, k_length_sigma);
    const double unit = model_.frame().scale();
    put(Kind::depth, {}, "", extent_along(corners, {0, 0, 1}), sigma, unit);
    for (int k = 0; k < k_directions; ++k) {
        const double azimuth_deg = 180.0 / k_directions * k;
        const Vec3 direction{std::cos(radians(azimuth_deg)), std::sin(radians(azimuth_deg)), 0};
        const std::string of = fmt::format("{:g}", azimuth_deg);
        put(Kind::width, {of}, "", extent_along(corners, direction), sigma, unit);
        if (table.size() < 3) continue;
        put(Kind::table_width, {of}, "", extent_along(table, direction), sigma, unit);
    }
}

void CandidateList::add_size() {
    const Formula volume = enclosed_volume(outline_);
    Reading whole;
    whole.kind = model_.stone().material.density_g_cm3 ? Kind::weight : Kind::volume;
    const double none = k_volume_sigma * volume(shape_).value;
    put(whole.kind, {}, "", volume, usual_sigma(model_, {Kind::weight, Kind::volume}, none),
        model_.frame().unit_of(whole));
}

}  // namespace

std::vector<CandidateReading> candidate_readings(const FitModel& model, const Shape& shape,
                                                 const std::shared_ptr<const Outline>& outline) {
    const Solid& solid = model.stone().solid;
    const std::vector<int> tier_of =
        tier_of_each(tiers_of(solid, model.stone().up), solid.facets.size());
    CandidateList list(model, shape, outline);
    list.add_facet_angles(tier_of);
    list.add_edges(tier_of);
    list.add_widths_and_depth();
    const bool encloses = std::any_of(outline->loops.begin(), outline->loops.end(),
                                      [](const std::vector<int>& loop) { return !loop.empty(); });
    if (encloses) list.add_size();
    return list.take();
}

}  // namespace culet
