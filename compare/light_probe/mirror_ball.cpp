#include "compare/light_probe/mirror_ball.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace culet {

namespace {

constexpr double k_farthest = 1e6;  // practically infinite: rays differ by a millionth

Vec3 ray_through(const PixelPlace& place, const PixelPlace& principal, double focal_px) {
    return glm::normalize(
        Vec3((place.x - principal.x) / focal_px, -(place.y - principal.y) / focal_px, -1.0));
}

// Rays v at the outline of a ball with half-angle alpha about the unit axis a satisfy v . a = cos
// alpha: linear least squares for v . m = 1 with m = a / cos alpha.
struct Cone {
    Vec3 axis;
    double distance;  // 1 / sin alpha
};
Cone cone_of(const BallCircle& circle, const PixelPlace& principal, double focal_px) {
    constexpr int k_points = 24;
    glm::dmat3 normal(0.0);
    Vec3 right(0.0);
    // In coordinates relative to the mean ray, where the equations of narrow cones are well
    // conditioned.
    const Vec3 mean = ray_through({circle.x, circle.y}, principal, focal_px);
    const Vec3 e1 = glm::normalize(glm::cross(mean, Vec3(0, 1, 0))), e2 = glm::cross(e1, mean);
    const double scale = focal_px / circle.radius;
    for (int k = 0; k < k_points; ++k) {
        const double angle = 2 * std::numbers::pi * k / k_points;
        const Vec3 v = ray_through({circle.x + circle.radius * std::cos(angle),
                                    circle.y + circle.radius * std::sin(angle)},
                                   principal, focal_px);
        // Tangent-plane coordinates (p, q) of the ray: p m1 + q m2 + m3 = 1 / (v . mean). Computes
        // 1 / cos - 1 without cancellation.
        const double forward = glm::dot(v, mean);
        const double p = glm::dot(v, e1) / forward * scale, q = glm::dot(v, e2) / forward * scale;
        const double r2 = (p * p + q * q) / (scale * scale);
        const double longer = r2 / (1 + std::sqrt(1 + r2)) * scale * scale;  // (|ray| - 1) scaled
        const Vec3 row(p, q, 1);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) normal[i][j] += row[i] * row[j];
            right[i] += row[i] * longer;
        }
    }
    const Vec3 m = glm::inverse(normal) * right;
    // Undo the scaling. m3 is relative to 1.
    const double m1 = m.x / scale, m2 = m.y / scale, m3 = m.z / (scale * scale);  // m3 minus 1
    const Vec3 whole = m1 * e1 + m2 * e2 + (1 + m3) * mean;
    // tan^2 alpha = |m|^2 - 1 (as 1 / cos^2 - 1)
    const double tan2 = m1 * m1 + m2 * m2 + m3 * (2 + m3);
    return {glm::normalize(whole), std::sqrt(1 + 1 / std::max(tan2, 1e-300))};
}

// Rotates (c, s) towards (1, 0) by twice the angle of this tangent.
void turn_back(double& c, double& s, double tangent) {
    const double t2 = tangent * tangent, x = (1 - t2) * c + 2 * tangent * s;
    s = ((1 - t2) * s - 2 * tangent * c) / (1 + t2);
    c = x / (1 + t2);
}

}  // namespace

MirrorBall::MirrorBall(const BallCircle& circle, const PixelPlace& principal, double focal_px,
                       double distance)
    : circle_(circle), principal_(principal), focal_px_(focal_px), distance_(distance) {
    const Cone cone = cone_of(circle, principal, focal_px);
    towards_camera_ = -cone.axis;
    centre_ = distance_ * cone.axis;
}

MirrorBall MirrorBall::at_distance(const BallCircle& circle, const PixelPlace& principal,
                                   double distance) {
    const double wanted = std::clamp(distance, 1.0 + 1e-6, k_farthest);
    const double across = std::sqrt(wanted * wanted - 1);  // 1 / tan alpha
    double focal_px = circle.radius * across;
    for (int i = 0; i < 30; ++i) {
        const double found = cone_of(circle, principal, focal_px).distance;
        const double step = across / std::sqrt(found * found - 1);
        focal_px *= step;
        if (std::abs(step - 1) < 1e-13) break;
    }
    return MirrorBall(circle, principal, focal_px, wanted);
}

MirrorBall MirrorBall::with_focal_length(const BallCircle& circle, const PixelPlace& principal,
                                         double focal_px) {
    const double distance = std::min(cone_of(circle, principal, focal_px).distance, k_farthest);
    return MirrorBall(circle, principal, focal_px, distance);
}

Vec3 MirrorBall::ray(const PixelPlace& place) const {
    return ray_through(place, principal_, focal_px_);
}

std::optional<MirrorBall::Reflection> MirrorBall::reflection_at(const PixelPlace& place) const {
    const Vec3 v = ray(place);
    // `beside` points from the centre to the ray's nearest point; |beside| = L sin psi.
    const double along = glm::dot(v, centre_);
    const Vec3 beside = along * v - centre_;
    const double inside = 1 - glm::dot(beside, beside);
    if (inside <= 0) return std::nullopt;
    const Vec3 normal = beside - std::sqrt(inside) * v;
    return Reflection{normal, glm::normalize(v - 2 * glm::dot(v, normal) * normal)};
}

std::optional<Vec3> MirrorBall::direction_of(const PixelPlace& place) const {
    const auto reflection = reflection_at(place);
    if (!reflection) return std::nullopt;
    return reflection->direction;
}

std::optional<PixelPlace> MirrorBall::place_of(const Vec3& direction) const {
    const Vec3 d = glm::normalize(direction);
    const double cosine = glm::dot(d, towards_camera_);
    Vec3 aside = d - cosine * towards_camera_;
    const double sine = glm::length(aside);
    if (cosine < 0 && sine * distance_ <= 1) return std::nullopt;  // the blind cone
    aside = sine > 0 ? aside / sine : Vec3(0);
    // The normal at phi from the camera's direction reflects the ray that meets it, psi off the
    // axis, to theta = 2 phi + psi. Newton with psi' = (L cos phi - 1) / (L^2 - 2 L cos phi + 1).
    // Uses the pair (c, s) instead of angles: the remaining angle is that of (c, s)^2 (L - c, s) /
    // (cosine, sine), and tan(x / 2) = sin x / (1 + cos x) rotates by it.
    const double l = distance_;
    double c = std::sqrt(std::max(0.0, (1 + cosine) / 2)),
           s = std::sqrt(std::max(0.0, (1 - cosine) / 2));
    turn_back(c, s, s / (l - c) / 4);
    for (int i = 0; i < 20; ++i) {
        const double square = l * l - 2 * l * c + 1, length = std::sqrt(square);
        // (c, s)^2 (L - c, s) = L (c, s)^2 - (c, s)
        const double x = l * (c * c - s * s) - c, y = 2 * l * c * s - s;
        const double left = (y * cosine - x * sine) / (length + x * cosine + y * sine);
        const double step = left / (2 + (l * c - 1) / square);
        turn_back(c, s, step);
        if (std::abs(step) < 5e-13) break;
    }
    const Vec3 point = centre_ + c * towards_camera_ + s * aside;
    if (point.z >= 0) return std::nullopt;
    return PixelPlace{principal_.x - focal_px_ * point.x / point.z,
                      principal_.y + focal_px_ * point.y / point.z};
}

std::optional<PixelPlace> MirrorBall::place_of_point(const Vec3& at, double nearness) const {
    // Alhazen's problem by fixed-point iteration: the direction from the ball's point that
    // reflected the last direction. Each step multiplies the error by about half the nearness.
    constexpr int k_steps = 60;
    Vec3 direction = glm::normalize(at);
    for (int i = 0; i < k_steps; ++i) {
        const auto place = place_of(direction);
        if (!place) return std::nullopt;
        const auto reflection = reflection_at(*place);
        if (!reflection) return std::nullopt;
        const Vec3 next = glm::normalize(at - nearness * reflection->at);
        const double step = glm::length(next - direction);
        direction = next;
        if (step < 1e-13) break;
    }
    return place_of(direction);
}

double MirrorBall::blind_half_angle() const {
    return std::asin(1 / distance_);
}

double MirrorBall::solid_angle_per_pixel() const {
    // At phi = 0: theta = (2 + 1 / (L - 1)) phi, and one pixel moves the surface point by (L - 1) /
    // focal length.
    const double per_pixel = (distance_ - 1) / focal_px_ * (2 + 1 / (distance_ - 1));
    return per_pixel * per_pixel;
}

}  // namespace culet
