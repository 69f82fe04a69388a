#include "fit/silhouettes/turning_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/silhouettes/find_planes.h"
#include "fit/silhouettes/turning_slopes.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_around = 16;     // directions of the planes to start with, in each of three rings
constexpr double k_ring = 0.85;  // their inclination, as part of the most that outlines show
// Facets brighter than the ground seem larger in a photograph, darker ones smaller, along whole
// sides: what most points say counts.
constexpr OutlierRule k_outliers{1, 0};
constexpr int k_turn_steps = 20, k_refit_steps = 40;
constexpr double k_still = 1e-7;  // radians: the turn moves no more

FlatContour flat(const PicturePoints& points) {
    FlatContour contour;
    for (const glm::dvec2& p : points) contour.points.push_back({p.x, p.y});
    contour.weights.assign(points.size(), 1);
    return contour;
}

// A facet appears edge-on if its normal is no steeper than the camera is off the axis.
std::vector<Plane> planes_around(const PlaneFitProblem& problem) {
    const double steepest = std::numbers::pi / 2 - std::abs(problem.from.series.camera.elevation);
    std::vector<Plane> planes;
    for (const double part : {-k_ring, 0.0, k_ring}) {
        for (int k = 0; k < k_around; ++k) {
            const double azimuth = 2 * std::numbers::pi * k / k_around, up = part * steepest;
            const Vec3 normal{std::cos(up) * std::cos(azimuth), std::cos(up) * std::sin(azimuth),
                              std::sin(up)};
            if (const auto offset = reach_along(normal, problem, problem.from))
                planes.push_back({normal, *offset});
        }
    }
    return planes;
}

PlaneFitProblem problem_of(const TurningOutlines& given) {
    PlaneFitProblem problem;
    glm::dvec2 least(1e300), most(-1e300);
    for (const PicturePoints& points : given.outlines) {
        problem.contours.push_back(flat(points));
        for (const glm::dvec2& p : points) {
            least = glm::min(least, p);
            most = glm::max(most, p);
        }
    }
    problem.width = glm::distance(least, most);
    problem.from.series = given.start;
    problem.expected = given.expected;
    problem.stated_sigmas = {0};
    problem.outliers = k_outliers;
    problem.start = given.planes.empty() ? planes_around(problem) : given.planes;
    problem.start_tilts.assign(problem.start.size(), k_turning_tilt);
    return problem;
}

// By how much errors that neighbouring points share make sigmas larger: root of 1 + 2 * sum of the
// autocorrelations along the outlines, to the first that is small.
double factor_of_shared_errors(const OutlineDistances& distances, double scale) {
    constexpr double k_small = 0.05;
    constexpr std::size_t k_furthest = 60;
    double sum = 1;
    double squares = 0;
    const auto clipped = [&](double d) { return std::clamp(d, -k_sure * scale, k_sure * scale); };
    for (const auto& nearest : distances.nearest) {
        for (const auto& n : nearest) squares += std::pow(clipped(n.distance), 2);
    }
    for (std::size_t lag = 1; lag < k_furthest && squares > 0; ++lag) {
        double products = 0;
        for (const auto& nearest : distances.nearest) {
            for (std::size_t i = 0; i + lag < nearest.size(); ++i)
                products += clipped(nearest[i].distance) * clipped(nearest[i + lag].distance);
        }
        if (products < k_small * squares) break;
        sum += 2 * products / squares;
    }
    return std::sqrt(sum);
}

std::vector<double> tilt_sigmas_of(const PlaneInformation& information) {
    const Eigen::MatrixXd covariance = PivotedCholesky(information.matrix).inverse();
    std::vector<double> sigmas;
    for (Eigen::Index at = 0; at < covariance.rows(); at += 3) {
        const double a = covariance(at, at), b = covariance(at, at + 1),
                     c = covariance(at + 1, at + 1);
        sigmas.push_back(std::sqrt((a + c) / 2 + std::hypot((a - c) / 2, b)));
    }
    return sigmas;
}

// Sigmas are `factor` times those of the fit.
TurningFit result_of(const PlaneFitProblem& problem, const PlaneFit& fit, double factor) {
    const PlaneInformation information = plane_information(problem, fit);
    const std::vector<double> sigmas = tilt_sigmas_of(information);
    TurningFit result;
    result.solid = fit.body.solid;
    for (Facet& facet : result.solid.facets) {
        const int plane = std::stoi(facet.name);
        facet.name = fmt::format("F{}", plane + 1);
        result.tilt_sigmas.push_back(std::min(k_turning_tilt, factor * sigmas[std::size_t(plane)]));
    }
    result.series = fit.from.series;
    result.scatter = fit.scales[0];
    for (const double sigma : information.turn_sigmas)
        result.turn_sigmas.push_back(std::min(problem.expected.turn_sigma, factor * sigma));
    return result;
}

}  // namespace

TurningFit fit_turning(const TurningOutlines& given) {
    PlaneFitProblem problem = problem_of(given);
    const FoundPlanes found = find_planes(Stone{}, problem);
    return result_of(problem, found.fit,
                     factor_of_shared_errors(found.fit.distances, found.fit.scales[0]));
}

TurningFit refit_turning(const TurningOutlines& given) {
    PlaneFitProblem problem = problem_of(given);
    problem.conditions = given.conditions;
    PlaneFit fit = fit_planes(problem, problem.start, 0);
    if (!fit.body.closed) throw InputError("the planes enclose no stone");
    problem.shared_errors =
        given.sigmas_times * factor_of_shared_errors(fit.distances, fit.scales[0]);
    fit = fit_planes(problem, problem.start, k_refit_steps);
    return result_of(problem, fit, 1);
}

PicturePoints outline_in_picture(std::span<const Vec3> corners, const TurningCamera& camera,
                                 double turn) {
    const PictureAxes at = picture_axes(camera, turn);
    PicturePoints polygon;
    for (const ProjectedOutline::Edge& e :
         projected_outline(corners, at.across, at.along, at.nearing).edges) {
        polygon.emplace_back(e.tx * e.begin + e.nx * e.offset + at.dx,
                             e.ty * e.begin + e.ny * e.offset + at.dy);
    }
    return polygon;
}

std::vector<FromOutline> outline_distances(std::span<const Vec3> corners,
                                           const TurningCamera& camera, double turn,
                                           const PicturePoints& points) {
    const std::vector<FlatContour> contours{flat(points)};
    const OutlineDistances at = outline_distances(corners, contours, {{}, {camera, {turn}}});
    std::vector<FromOutline> distances;
    for (const auto& [edge, distance] : at.nearest[0])
        distances.push_back({distance, at.outlines[0].edges[std::size_t(edge)].length});
    return distances;
}

FittedTurn fitted_turn(std::span<const Vec3> corners, const TurningCamera& camera, double start,
                       const PicturePoints& points, double scatter) {
    const std::vector<FlatContour> contours{flat(points)};
    FittedTurn fitted{start, HUGE_VAL};
    for (int i = 0; i < k_turn_steps; ++i) {
        const Viewpoints from{{}, {camera, {fitted.turn}}};
        const OutlineDistances at = outline_distances(corners, contours, from);
        const PlacedContour place = from.placed(contours, 0);
        const double scale = std::max(scatter, robust_scale(at, contours, 0));
        double squares = 0, sum = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            const auto& [edge, distance] = at.nearest[0][p];
            const ProjectedOutline::Edge& e = at.outlines[0].edges[std::size_t(edge)];
            const auto slope = [&](int corner) {
                return picture_slopes(camera, fitted.turn, e.nx, e.ny, corners[std::size_t(corner)])
                    .by_turn;
            };
            const double t = at.outlines[0].part_of(e, points[p].x + place.dx, points[p].y);
            const double by_turn = (1 - t) * slope(e.from) + t * slope(e.to);
            const double weight = inlier_weight(distance, scale, k_outliers);
            squares += weight * by_turn * by_turn;
            sum += weight * by_turn * distance;
        }
        if (!(squares > 0)) break;
        fitted.turn += sum / squares;
        fitted.sigma = scale / std::sqrt(squares);
        if (std::abs(sum / squares) < k_still) break;
    }
    return fitted;
}

}  // namespace culet
