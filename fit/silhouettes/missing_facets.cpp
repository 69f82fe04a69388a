#include "fit/silhouettes/missing_facets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// Least mean depth of a cut, in scales of one point's scatter.
constexpr double k_depth = 1.0;
// Part of the shorter edge at a corner: points nearer to the corner would be cut off.
constexpr double k_near_corner = 0.25;
// A cut nearer than this to a plane is that plane.
const double k_same_plane = radians(0.3);
// Part of a cut's angle to the nearest plane: cuts nearer to each other belong to one place.
constexpr double k_apart = 0.8;

struct Place {
    double weight = 0, sum = 0;
    void add(double w, double distance) {
        weight += w;
        sum += w * distance;
    }
    double mean() const { return weight > 0 ? sum / weight : 0; }
};

struct Cut {
    Plane plane;
    double depth = 0;
};

// Mean distances of one outline's points along an edge and near its two ends.
struct EdgePlaces {
    Place whole, begin, end;
};

std::vector<EdgePlaces> places_of(const PlaneFitProblem& problem, const PlaneFit& fit,
                                  std::size_t c, const PlacedContour& at, double scale) {
    const FlatContour& contour = problem.contours[c];
    const ProjectedOutline& outline = fit.distances.outlines[c];
    std::vector<EdgePlaces> places(outline.edges.size());
    const auto length = [&](std::size_t k) {
        return outline.edges[k % outline.edges.size()].length;
    };
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const auto& [edge, distance] = fit.distances.nearest[c][i];
        // Points far outside the body are dust, and no evidence against a cut beside them.
        const double w = contour.weights[i];
        if (edge < 0) continue;
        if (!(inlier_weight(std::sqrt(w) * std::max(distance, 0.0), scale, problem.outliers) > 0)) {
            continue;
        }
        const auto k = std::size_t(edge);
        const ProjectedOutline::Edge& e = outline.edges[k];
        const double along =
            outline.part_of(e, contour.points[i][0] + at.dx, contour.points[i][1] + at.dy) *
            e.length;
        places[k].whole.add(w, distance);
        const double before = length(k + outline.edges.size() - 1), after = length(k + 1);
        if (along < k_near_corner * std::min(e.length, before)) places[k].begin.add(w, distance);
        if (e.length - along < k_near_corner * std::min(e.length, after)) {
            places[k].end.add(w, distance);
        }
    }
    return places;
}

// Sum of weighted squares, in variances, that a plane must save: log(points) for each of its three
// parameters (Schwarz 1978). A cut saves mean^2 * weight in the outline that shows it best.
double least_gain_of_plane(const PlaneFitProblem& problem) {
    std::size_t points = 0;
    for (const FlatContour& contour : problem.contours) points += contour.points.size();
    return 3 * std::log(double(points));
}

bool stands_out(const Place& place, double scale, double least_gain) {
    return -place.mean() > k_depth * scale &&
           std::pow(place.mean() / scale, 2) * place.weight > least_gain;
}

void add_cuts(const PlaneFitProblem& problem, const PlaneFit& fit, std::size_t c, double least_gain,
              std::vector<Cut>& cuts) {
    const FlatContour& contour = problem.contours[c];
    const ProjectedOutline& outline = fit.distances.outlines[c];
    const double scale = fit.scales[std::size_t(contour.set)];
    const PlacedContour at = fit.from.placed(problem.contours, c);
    const std::vector<EdgePlaces> places = places_of(problem, fit, c, at, scale);
    const std::size_t count = outline.edges.size();
    const auto normal = [&](const ProjectedOutline::Edge& e) {
        return e.nx * at.across + e.ny * at.along;
    };
    for (std::size_t k = 0; k < count; ++k) {
        const ProjectedOutline::Edge &e = outline.edges[k], &next = outline.edges[(k + 1) % count];
        const Vec3 n = normal(e);
        if (stands_out(places[k].whole, scale, least_gain)) {
            cuts.push_back({{n, e.offset + places[k].whole.mean()}, -places[k].whole.mean()});
        }
        Place corner = places[k].end;
        const Place& other = places[(k + 1) % count].begin;
        corner.weight += other.weight;
        corner.sum += other.sum;
        if (!stands_out(corner, scale, least_gain)) continue;
        const Vec3 between = glm::normalize(n + normal(next));
        const Vec3& tip = fit.body.corners[std::size_t(e.to)];
        cuts.push_back({{between, glm::dot(between, tip) + corner.mean()}, -corner.mean()});
    }
}

}  // namespace

std::vector<Plane> missing_planes(const PlaneFitProblem& problem, const PlaneFit& fit,
                                  std::size_t most) {
    std::vector<Cut> cuts;
    const double least_gain = least_gain_of_plane(problem);
    for (std::size_t c = 0; c < problem.contours.size(); ++c) {
        add_cuts(problem, fit, c, least_gain, cuts);
    }
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const Cut& a, const Cut& b) { return a.depth > b.depth; });
    std::vector<Plane> planes;
    for (const Cut& cut : cuts) {
        if (planes.size() >= most) break;
        const auto nearest = [&](const std::vector<Plane>& others) {
            double angle = std::numbers::pi;
            for (const Plane& other : others) {
                angle = std::min(angle, angle_between(cut.plane.normal, other.normal));
            }
            return angle;
        };
        const double old = nearest(fit.planes);
        const bool is_there = old < k_same_plane || nearest(planes) < k_apart * old;
        if (!is_there) planes.push_back(cut.plane);
    }
    return planes;
}

}  // namespace culet
