#include "fit/findings/optimal_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fit/model/facet_functions.h"
#include "fit/model/outline_corners.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

using Kind = ReadingKind;

constexpr std::size_t k_tried = 80;  // most promising candidates, evaluated in full
constexpr std::size_t k_proposed = 5;
// Edges of a large stone that are tried, about: each costs linear solutions.
constexpr std::size_t k_most_edges = 600;
// Directions of widths, over half a turn.
constexpr int k_directions = 16;
// Used if no similar reading was taken: radians, half diameters, and part of the volume.
constexpr double k_angle_sigma = radians(0.1), k_length_sigma = 0.002, k_volume_sigma = 0.002;

// A reading that was not taken, linear in the unknowns; in the scale of the fit.
struct Candidate {
    NextReading reading;
    FunctionRow function;
    double sigma = 0;
    std::string group;  // kind and tier
    double variance = 0, promise = 0;
};

class Candidates {
public:
    Candidates(const FitModel& model, const Shape& shape,
               const std::shared_ptr<const Outline>& outline)
        : model_(model), shape_(shape), outline_(outline), writer_(shape) {
        const Solid& solid = model.stone().solid;
        tier_of_ = tier_of_each(tiers_of(solid, model.stone().up), solid.facets.size());
        add_facet_angles();
        add_edges();
        add_widths_and_depth();
        add_size();
    }
    std::vector<Candidate> all;

private:
    double usual_sigma(const std::set<Kind>& kinds, double none) const;
    void put(Kind kind, std::vector<std::string> of, const std::string& group,
             const Formula& formula, double sigma, double unit);
    void put_extent(Kind kind, std::vector<std::string> of, const Vec3& direction);
    void add_facet_angles();
    void add_edges();
    void add_widths_and_depth();
    void add_size();
    const std::string& name(int f) const {
        return model_.stone().solid.facets[std::size_t(f)].name;
    }

    const FitModel& model_;
    const Shape& shape_;
    const std::shared_ptr<const Outline>& outline_;
    RowWriter writer_;
    std::vector<int> tier_of_;
};

// Median sigma of readings of these kinds in the scale of the fit, or `none`.
double Candidates::usual_sigma(const std::set<Kind>& kinds, double none) const {
    std::vector<double> sigmas;
    for (const Reading& r : model_.readings()) {
        if (r.exact || !(r.sigma > 0) || kinds.count(r.kind) == 0) continue;
        sigmas.push_back(r.sigma / model_.frame().unit_of(r));
    }
    return sigmas.empty() ? none : upper_median(std::move(sigmas));
}

// `unit` converts from the scale of the fit to the reading's unit.
void Candidates::put(Kind kind, std::vector<std::string> of, const std::string& group,
                     const Formula& formula, double sigma, double unit) {
    all.push_back({{kind, std::move(of), sigma * unit},
                   writer_.function(formula(shape_)),
                   sigma,
                   fmt::format("{} {}", name_of(kind), group)});
}

void Candidates::add_facet_angles() {
    const double tilt = usual_sigma({Kind::inclination}, k_angle_sigma),
                 turn = usual_sigma({Kind::azimuth}, k_angle_sigma);
    for (int f = 0; f < int(tier_of_.size()); ++f) {
        const Vec3& n = shape_.normals[std::size_t(f)];
        if (f == model_.frame().up_facet() || std::hypot(n.x, n.y) < 1e-6) continue;
        const std::string tier = std::to_string(tier_of_[std::size_t(f)]);
        put(Kind::inclination, {name(f)}, tier, tilt_from_up(f), tilt, 1);
        put(Kind::azimuth, {name(f)}, tier, azimuth_error(f, -1, std::atan2(n.y, n.x)), turn, 1);
    }
}

// Only someone who has read most of the stone may have a microscope with a scale.
void Candidates::add_edges() {
    const bool were_read = std::any_of(model_.readings().begin(), model_.readings().end(),
                                       [](const Reading& r) { return r.kind == Kind::edge; });
    if (model_.meets().splits || (!model_.prior().empty() && !were_read)) return;
    const double sigma =
        usual_sigma({Kind::edge, Kind::distance},
                    usual_sigma({Kind::width, Kind::depth, Kind::table_width}, k_length_sigma));
    const std::vector<Edge>& edges = model_.edges().edges;
    for (std::size_t at = 0; at < edges.size(); at += 1 + edges.size() / k_most_edges) {
        const Edge& e = edges[at];
        if (e.left < 0 || e.right < 0) continue;
        const auto [one, other] =
            std::minmax(tier_of_[std::size_t(e.left)], tier_of_[std::size_t(e.right)]);
        put(Kind::edge, {name(e.left), name(e.right)}, fmt::format("{}/{}", one, other),
            corner_distance(Corner{e.from}, Corner{e.to}), sigma, model_.frame().scale());
    }
}

void Candidates::put_extent(Kind kind, std::vector<std::string> of, const Vec3& direction) {
    Reading reading;
    reading.kind = kind;
    const std::vector<Corner> corners = corners_between_jaws(model_, reading, *outline_);
    if (corners.empty()) return;
    put(kind, std::move(of), "",
        extent(farthest(shape_, corners, direction), farthest(shape_, corners, -direction),
               direction),
        usual_sigma({Kind::width, Kind::depth, Kind::table_width}, k_length_sigma),
        model_.frame().scale());
}

void Candidates::add_widths_and_depth() {
    put_extent(Kind::depth, {}, {0, 0, 1});
    for (int k = 0; k < k_directions; ++k) {
        const double azimuth_deg = 180.0 / k_directions * k;
        const Vec3 direction{std::cos(radians(azimuth_deg)), std::sin(radians(azimuth_deg)), 0};
        const std::string of = fmt::format("{:g}", azimuth_deg);
        put_extent(Kind::width, {of}, direction);
        if (model_.frame().up_facet() >= 0) put_extent(Kind::table_width, {of}, direction);
    }
}

void Candidates::add_size() {
    if (outline_->corners.empty()) return;
    const Formula volume = enclosed_volume(outline_);
    Reading whole;
    whole.kind = model_.stone().material.density_g_cm3 ? Kind::weight : Kind::volume;
    const double none = k_volume_sigma * volume(shape_).value;
    put(whole.kind, {}, "", volume, usual_sigma({Kind::weight, Kind::volume}, none),
        model_.frame().unit_of(whole));
}

template <typename Value>
void sort_by(std::vector<Candidate>& candidates, const Value& value) {  // the largest first
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const auto& a, const auto& b) { return value(a) > value(b); });
}

// Sums `part` over both tilts and the offset of all facets.
template <typename Part>
double sum_over_facets(const Shape& shape, const Part& part) {
    const Layout layout = layout_of(shape);
    const Vec3 middle = middle_of(shape);
    double sum = 0;
    for (int f = 0; f < layout.facets; ++f) {
        for (int k = 0; k < 2; ++k) {
            FunctionRow tilt(layout.size());
            tilt.coeffRef(layout.tilt(f) + k) = 1;
            sum += part(tilt);
        }
        sum += part(facet_functions(shape, f, layout, middle)[2]);
    }
    return sum;
}

// The most promising, at most two of every kind and tier, because their reach differs.
std::vector<Candidate> most_promising(std::vector<Candidate> all, const Covariance& covariance) {
    for (Candidate& c : all) {
        c.variance = covariance.total_variance(c.function);
        const double squares = c.function.squaredNorm();
        // Too few readings make the variance infinite.
        if (!std::isfinite(c.variance) || !(c.variance > 0) || !(squares > 0)) continue;
        c.promise = c.variance * (c.variance / (c.sigma * c.sigma + c.variance)) / squares;
    }
    sort_by(all, [](const Candidate& c) { return c.promise; });
    std::map<std::string, int> of_group;
    std::erase_if(all,
                  [&](const Candidate& c) { return !(c.promise > 0) || ++of_group[c.group] > 2; });
    if (all.size() > k_tried) all.erase(all.begin() + k_tried, all.end());
    return all;
}

}  // namespace

std::vector<NextReading> next_readings(const FitModel& model, const Shape& shape,
                                       const std::shared_ptr<const Outline>& outline,
                                       const Covariance& covariance) {
    const double total = sum_over_facets(
        shape, [&](const FunctionRow& row) { return covariance.total_variance(row); });
    if (!(total > 0) || !std::isfinite(total)) return {};
    std::vector<Candidate> tried =
        most_promising(Candidates(model, shape, outline).all, covariance);
    for (Candidate& c : tried) {
        const Eigen::VectorXd with = covariance.with_all(c.function, true);
        const double drop = sum_over_facets(shape, [&](const FunctionRow& row) {
            const double common = row.dot(with);
            return common * common;
        });
        const double share = drop / (c.sigma * c.sigma + c.variance) / total;
        c.reading.reduces = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
        // It must be tighter than the mesh, and the mesh must have given most of the variance.
        const double open = covariance.rank_defect() > 0 ? covariance.open_variance(c.function) : 0;
        c.reading.closes = open > 4 * c.sigma * c.sigma && open > 0.5 * c.variance;
    }
    sort_by(tried, [](const Candidate& c) { return c.reading.reduces; });
    std::vector<NextReading> best;
    std::set<std::string> told;
    for (const Candidate& c : tried) {
        if (best.size() == k_proposed || !(c.reading.reduces > 1e-6)) break;
        if (told.insert(c.group).second) best.push_back(c.reading);
    }
    return best;
}

}  // namespace culet
