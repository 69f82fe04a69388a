#include "fit/silhouettes/plane_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/silhouettes/turning_slopes.h"

namespace culet {

namespace {

using Slopes = PlaneSolver::Slopes;

constexpr int k_camera = 4;  // unknowns

// Sigma of a plane's offset about its start. It holds planes that no outline shows, and is too weak
// to matter beside an outline's point.
constexpr double k_start_offset = 0.02;  // of the width

FrameMotion turned_and_shifted(const FrameMotion& m, const Vec3& turn, const Vec3& shift) {
    const double angle = glm::length(turn);
    FrameMotion next = m;
    if (angle > 0) {
        const Vec3 axis = turn / angle;
        const auto about = [&](const Vec3& v) {
            return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
                   (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
        };
        next.x = glm::normalize(about(m.x));
        next.y = about(m.y);
        next.y = glm::normalize(next.y - glm::dot(next.x, next.y) * next.x);
        next.z = glm::cross(next.x, next.y);
    }
    next.shift += shift;
    return next;
}

// Derivatives of a corner's coordinate along a direction.
Slopes slopes_of_corner(const std::vector<Plane>& planes, const PlaneBody& body, int corner,
                        const Vec3& direction) {
    Slopes all;
    const std::array<int, 3>& crossing = body.planes[std::size_t(corner)];
    const CornerSlopes slopes = corner_slopes(planes, crossing);
    const Vec3& place = body.corners[std::size_t(corner)];
    for (std::size_t i = 0; i < 3; ++i) {
        const double along = glm::dot(direction, slopes.along[i]);
        const int p = crossing[i];
        const auto [t, u] = tilts_of(planes[std::size_t(p)].normal);
        all.add(3 * p, -along * glm::dot(t, place));
        all.add(3 * p + 1, -along * glm::dot(u, place));
        all.add(3 * p + 2, along);
    }
    return all;
}

Slopes slopes_of(const PlaneCondition& condition, const std::vector<Plane>& planes) {
    Slopes all;
    for (const PlaneCondition::Part& part : condition.parts) {
        const auto [t, u] = tilts_of(planes[std::size_t(part.plane)].normal);
        all.add(3 * part.plane, glm::dot(t, part.by_normal));
        all.add(3 * part.plane + 1, glm::dot(u, part.by_normal));
        all.add(3 * part.plane + 2, part.by_offset);
    }
    return all;
}

void add_products(Eigen::MatrixXd& matrix, const Slopes& a, const Slopes& b, double weight) {
    if (weight == 0) return;
    for (int i = 0; i < a.count; ++i) {
        for (int j = 0; j < b.count; ++j) {
            const int row = a.column[std::size_t(i)], column = b.column[std::size_t(j)];
            if (row >= column) {
                matrix(row, column) += weight * a.slope[std::size_t(i)] * b.slope[std::size_t(j)];
            }
        }
    }
}

void add_gradient(Eigen::VectorXd& gradient, const Slopes& a, double weight) {
    for (int i = 0; i < a.count; ++i) {
        gradient(a.column[std::size_t(i)]) += weight * a.slope[std::size_t(i)];
    }
}

// Sums over an edge's points. A point with its foot at part t follows the edge's ends with weights
// 1 - t and t.
struct EdgeSums {
    double begin_begin = 0, begin_end = 0, end_end = 0, begin = 0, end = 0;
};

}  // namespace

double residual(const PlaneCondition& condition, const std::vector<Plane>& planes) {
    double sum = -condition.value;
    for (const PlaneCondition::Part& part : condition.parts) {
        const Plane& plane = planes[std::size_t(part.plane)];
        sum += glm::dot(part.by_normal, plane.normal) + part.by_offset * plane.offset;
    }
    return sum;
}

PlaneSolver::PlaneSolver(const PlaneFitProblem& problem)
    : problem_(problem), planes_(int(problem.start.size())), size_(3 * planes_) {
    for (const bool is_free : problem.is_free) {
        column_of_set_.push_back(is_free ? size_ : -1);
        if (is_free) size_ += 6;
    }
    const std::size_t turns = problem.from.series.turns.size();
    if (turns > 0) {
        camera_column_ = size_;
        size_ += k_camera + int(turns);
    }
}

bool PlaneSolver::look(PlaneState& state) const {
    state.body = enclosed_body(state.planes);
    if (!state.body.closed) return false;
    state.distances = outline_distances(state.body.corners, problem_.contours, state.from);
    return true;
}

std::vector<double> PlaneSolver::scales(const PlaneState& state) const {
    std::vector<double> all;
    for (std::size_t s = 0; s < problem_.stated_sigmas.size(); ++s) {
        all.push_back(std::max(robust_scale(state.distances, problem_.contours, int(s)),
                               1e-9 * problem_.width));
    }
    return all;
}

PlaneSolver::Weights PlaneSolver::weights(const PlaneState& state,
                                          const std::vector<double>& scales) const {
    Weights all;
    for (std::size_t c = 0; c < problem_.contours.size(); ++c) {
        const FlatContour& contour = problem_.contours[c];
        std::vector<double>& mine = all.emplace_back();
        for (std::size_t i = 0; i < contour.points.size(); ++i) {
            const double w = contour.weights[i];
            mine.push_back(w * inlier_weight(std::sqrt(w) * state.distances.nearest[c][i].distance,
                                             scales[std::size_t(contour.set)], problem_.outliers));
        }
    }
    return all;
}

double PlaneSolver::cost(const PlaneState& state, const Weights& weights,
                         const std::vector<double>& sigmas) const {
    double sum = 0;
    for (std::size_t c = 0; c < weights.size(); ++c) {
        double own = 0;
        for (std::size_t i = 0; i < weights[c].size(); ++i) {
            own += weights[c][i] * std::pow(state.distances.nearest[c][i].distance, 2);
        }
        sum += own / std::pow(sigmas[std::size_t(problem_.contours[c].set)], 2);
    }
    for (std::size_t p = 0; p < state.planes.size(); ++p) {
        const Plane &mine = state.planes[p], &its = problem_.start[p];
        const Vec3 tilt = mine.normal - its.normal;
        sum += glm::dot(tilt, tilt) / std::pow(problem_.start_tilts[p], 2) +
               std::pow((mine.offset - its.offset) / (k_start_offset * problem_.width), 2);
    }
    for (const PlaneCondition& condition : problem_.conditions)
        sum += std::pow(residual(condition, state.planes) / condition.sigma, 2);
    const std::vector<double>& turns = state.from.series.turns;
    for (std::size_t c = 0; c < turns.size(); ++c)
        sum += std::pow((turns[c] - problem_.expected.turns[c]) / problem_.expected.turn_sigma, 2);
    for (std::size_t i = 0; i < std::size_t(k_camera) && camera_column_ >= 0; ++i) {
        const double sigma = problem_.expected.sigmas[i];
        const double off =
            state.from.series.camera.values()[i] - problem_.expected.camera.values()[i];
        if (sigma > 0) sum += std::pow(off / sigma, 2);
    }
    return sum;
}

// The distance is the point's height over the edge: it shrinks as the edge moves out.
Slopes PlaneSolver::slopes_in_set(const PlaneState& state, const PlacedContour& place, int set,
                                  const ProjectedOutline::Edge& e, int corner) const {
    const Vec3 n = e.nx * place.across + e.ny * place.along;
    Slopes s = slopes_of_corner(state.planes, state.body, corner, -n);
    const int column = column_of_set_[std::size_t(set)];
    if (column < 0) return s;
    const Vec3& shift = state.from.motions[std::size_t(set)].shift;
    const Vec3 turn = -glm::cross(n, state.body.corners[std::size_t(corner)] - shift);
    for (int i = 0; i < 3; ++i) {
        s.add(column + i, n[i]);
        s.add(column + 3 + i, turn[i]);
    }
    return s;
}

Slopes PlaneSolver::slopes_in_series(const PlaneState& state, std::size_t c,
                                     const ProjectedOutline::Edge& e, int corner) const {
    const TurningSeries& series = state.from.series;
    const PictureSlopes by = picture_slopes(series.camera, series.turns[c], e.nx, e.ny,
                                            state.body.corners[std::size_t(corner)]);
    Slopes s = slopes_of_corner(state.planes, state.body, corner, -by.by_place);
    s.add(camera_column_, -by.by_axis);
    s.add(camera_column_ + 1, -by.by_roll);
    s.add(camera_column_ + 2, -by.by_elevation);
    s.add(camera_column_ + 3, -by.by_perspective);
    s.add(camera_column_ + k_camera + int(c), -by.by_turn);
    return s;
}

void PlaneSolver::add_contour(const PlaneState& state, std::size_t c,
                              const std::vector<double>& weights, double sigma,
                              PlaneSolver::Equations& to) const {
    const FlatContour& contour = problem_.contours[c];
    const PlacedContour place = state.from.placed(problem_.contours, c);
    const ProjectedOutline& outline = state.distances.outlines[c];
    std::vector<EdgeSums> sums(outline.edges.size());
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const auto& [edge, distance] = state.distances.nearest[c][i];
        if (edge < 0 || weights[i] == 0) continue;
        const double w = weights[i] / (sigma * sigma);
        const double t =
            outline.part_of(outline.edges[std::size_t(edge)], contour.points[i][0] + place.dx,
                            contour.points[i][1] + place.dy);
        EdgeSums& sum = sums[std::size_t(edge)];
        sum.begin_begin += w * (1 - t) * (1 - t);
        sum.begin_end += w * (1 - t) * t;
        sum.end_end += w * t * t;
        sum.begin += w * (1 - t) * distance;
        sum.end += w * t * distance;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const EdgeSums& sum = sums[k];
        if (sum.begin_begin == 0 && sum.end_end == 0) continue;
        const ProjectedOutline::Edge& e = outline.edges[k];
        const auto end_slopes = [&](int corner) {
            return camera_column_ < 0 ? slopes_in_set(state, place, contour.set, e, corner)
                                      : slopes_in_series(state, c, e, corner);
        };
        const Slopes begin = end_slopes(e.from), end = end_slopes(e.to);
        add_products(to.matrix, begin, begin, sum.begin_begin);
        add_products(to.matrix, begin, end, sum.begin_end);
        add_products(to.matrix, end, begin, sum.begin_end);
        add_products(to.matrix, end, end, sum.end_end);
        add_gradient(to.gradient, begin, sum.begin);
        add_gradient(to.gradient, end, sum.end);
    }
}

PlaneSolver::Equations PlaneSolver::equations(const PlaneState& state, const Weights& weights,
                                              const std::vector<double>& sigmas,
                                              bool with_start) const {
    Equations all;
    all.matrix = Eigen::MatrixXd::Zero(size_, size_);
    all.gradient = Eigen::VectorXd::Zero(size_);
    for (std::size_t c = 0; c < problem_.contours.size(); ++c) {
        add_contour(state, c, weights[c], sigmas[std::size_t(problem_.contours[c].set)], all);
    }
    if (!with_start) return all;
    const double offset = 1 / std::pow(k_start_offset * problem_.width, 2);
    for (int p = 0; p < planes_; ++p) {
        const Plane &mine = state.planes[std::size_t(p)], &its = problem_.start[std::size_t(p)];
        const auto along = tilts_of(mine.normal);
        const double tilt = 1 / std::pow(problem_.start_tilts[std::size_t(p)], 2);
        for (int k = 0; k < 2; ++k) {
            all.matrix(3 * p + k, 3 * p + k) += tilt;
            all.gradient(3 * p + k) +=
                tilt * glm::dot(along[std::size_t(k)], mine.normal - its.normal);
        }
        all.matrix(3 * p + 2, 3 * p + 2) += offset;
        all.gradient(3 * p + 2) += offset * (mine.offset - its.offset);
    }
    for (const PlaneCondition& condition : problem_.conditions) {
        const Slopes slopes = slopes_of(condition, state.planes);
        const double weight = 1 / (condition.sigma * condition.sigma);
        add_products(all.matrix, slopes, slopes, weight);
        add_gradient(all.gradient, slopes, weight * residual(condition, state.planes));
    }
    const std::vector<double>& turns = state.from.series.turns;
    for (std::size_t c = 0; c < turns.size(); ++c) {
        const int at = camera_column_ + k_camera + int(c);
        const double information = 1 / std::pow(problem_.expected.turn_sigma, 2);
        all.matrix(at, at) += information;
        all.gradient(at) += information * (turns[c] - problem_.expected.turns[c]);
    }
    for (int i = 0; i < k_camera && camera_column_ >= 0; ++i) {
        const auto k = std::size_t(i);
        const double sigma = problem_.expected.sigmas[k];
        if (!(sigma > 0)) continue;
        const int at = camera_column_ + i;
        all.matrix(at, at) += 1 / (sigma * sigma);
        all.gradient(at) +=
            (state.from.series.camera.values()[k] - problem_.expected.camera.values()[k]) /
            (sigma * sigma);
    }
    return all;
}

PlaneState PlaneSolver::moved(const PlaneState& state, const Eigen::VectorXd& step) const {
    PlaneState next;
    next.planes = state.planes;
    for (int p = 0; p < planes_; ++p) {
        Plane& plane = next.planes[std::size_t(p)];
        const auto [t, u] = tilts_of(plane.normal);
        plane.normal = glm::normalize(plane.normal + step(3 * p) * t + step(3 * p + 1) * u);
        plane.offset += step(3 * p + 2);
    }
    next.from = state.from;
    for (std::size_t s = 0; s < column_of_set_.size(); ++s) {
        const int at = column_of_set_[s];
        if (at < 0) continue;
        next.from.motions[s] =
            turned_and_shifted(next.from.motions[s], {step(at + 3), step(at + 4), step(at + 5)},
                               {step(at), step(at + 1), step(at + 2)});
    }
    if (camera_column_ >= 0) {
        TurningCamera& camera = next.from.series.camera;
        camera.axis += step(camera_column_);
        camera.roll += step(camera_column_ + 1);
        camera.elevation += step(camera_column_ + 2);
        camera.perspective += step(camera_column_ + 3);
        for (std::size_t c = 0; c < next.from.series.turns.size(); ++c)
            next.from.series.turns[c] += step(camera_column_ + k_camera + int(c));
    }
    return next;
}

}  // namespace culet
