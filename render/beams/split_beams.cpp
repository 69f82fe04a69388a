#include "render/beams/split_beams.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/solid/least_rotation.h"

namespace culet {

namespace {

// Pixels between the reference ray and its neighbours: finite differences keep about half the
// digits of double precision.
constexpr double k_beside = 1e-3;
// Each face is a recursive call that takes 5 kB of stack, and threads have 4 MB (8 at most). Deeper
// light counts as remainder.
constexpr int k_deepest_call = 200;
// Outside the stone the reference ray may pass its facet's plane and come back, and so regain
// absorbed light. To first order that is right for points of a small beam. This bounds the exponent
// for absorption so strong that first order fails.
constexpr double k_most_regained = 1;

std::array<double, 3> with_changes(const std::array<double, 3>& v) {
    return {v[0], (v[1] - v[0]) / k_beside, (v[2] - v[0]) / k_beside};
}
std::array<Vec3, 3> with_changes(const std::array<Vec3, 3>& v) {
    return {v[0], (v[1] - v[0]) / k_beside, (v[2] - v[0]) / k_beside};
}

// What leaves the stone on the reference ray and on its neighbours.
struct LeavingRays {
    std::array<Vec3, 3> points, directions, tangents;
    std::array<double, 3> weights{}, Q{}, U{};

    LeavingBeam beam(const ScreenPoint& reference) const {
        LeavingBeam beam;
        beam.reference = reference;
        beam.point = with_changes(points);
        beam.direction = with_changes(directions);
        beam.s = with_changes(tangents);
        beam.weight = with_changes(weights);
        beam.Q = with_changes(Q);
        beam.U = with_changes(U);
        return beam;
    }
};

// Radiance behind the eye's optics, from amplitudes along the picture's x and y.
double seen(const Stokes& response, const Complex& x, const Complex& y) {
    const Complex xy = x * std::conj(y);
    return 0.5 * ((response[0] + response[1]) * std::norm(x) +
                  (response[0] - response[1]) * std::norm(y)) +
           response[2] * xy.real() + response[3] * xy.imag();
}

}  // namespace

SplitBeams::SplitBeams(const FacetNet& net, const Band& band, const SplitLimits& limits,
                       const Stokes& response)
    : net_(net), band_(band), limits_(limits), response_(response) {
    limits_.depth = std::min(limits_.depth, k_deepest_call);
    splitter_.prepare(net);
}

double SplitBeams::mean_transmitted(const Ray& ray) const {
    double sum = 0;
    for (int i = 0; i < band_.count; ++i) sum += ray.transmitted[static_cast<std::size_t>(i)];
    return sum / band_.count;
}

void SplitBeams::grow(const ScreenView& view, int facet, const ScreenPoint* region,
                      std::size_t count, const Sink& sink) {
    sink_ = &sink;
    pool_.assign(region, region + count);
    reference_ = middle_of(region, count);
    const FacetRegion part{facet, {0, count}, doubled_area(region, count)};
    const Plane& plane = net_.plane(facet);
    std::array<Rays, 2> inside;
    LeavingRays mirrored;
    for (std::size_t i = 0; i < 3; ++i) {
        const ScreenPoint at{reference_.x + (i == 1 ? k_beside : 0),
                             reference_.y + (i == 2 ? k_beside : 0)};
        const Vec3 origin = view.origin(at), d = glm::normalize(view.towards(at));
        const double cosine = glm::dot(plane.normal, d);
        const Vec3 point = origin - height_above(plane, origin) / cosine * d;
        const CrystalEntry entry =
            enter_crystal(band_.crystal, band_.n_outside,
                          band_.n_outside * (d - cosine * plane.normal), -plane.normal);
        // The eye's two polarisations in the face's frame.
        const Vec3 x = turned_with(view.forward, d, view.right), y = glm::cross(x, d), s = entry.s,
                   p = glm::cross(d, s);
        const double xs = glm::dot(x, s), xp = glm::dot(x, p), ys = glm::dot(y, s),
                     yp = glm::dot(y, p);
        for (std::size_t m = 0; m < 2; ++m) {
            Ray& ray = inside[m][i];
            ray.point = point;
            ray.mode = entry.modes[m];
            ray.weight = seen(response_, xs * entry.into[0][m] + xp * entry.into[1][m],
                              ys * entry.into[0][m] + yp * entry.into[1][m]);
            std::fill_n(ray.transmitted.begin(), band_.count, 1.0);
        }
        mirrored.points[i] = point;
        mirrored.directions[i] = d - 2 * cosine * plane.normal;
        mirrored.tangents[i] = s;
        // Reflected light that vibrates along s, along p and at 45 degrees.
        const auto reflected = [&](const Complex& of_s, const Complex& of_p) {
            const Complex in_s = of_s * entry.back[0][0] + of_p * entry.back[0][1],
                          in_p = of_s * entry.back[1][0] + of_p * entry.back[1][1];
            return seen(response_, xs * in_s + xp * in_p, ys * in_s + yp * in_p);
        };
        const double along_s = reflected(1, 0), along_p = reflected(0, 1);
        const double half = std::sqrt(0.5);
        mirrored.weights[i] = along_s + along_p;
        mirrored.Q[i] = along_s - along_p;
        mirrored.U[i] = reflected(half, half) - reflected(half, -half);
    }
    LeavingBeam beam = mirrored.beam(reference_);
    std::fill_n(beam.transmitted[0].begin(), band_.count, 1.0);
    ++beams_;
    sink(beam, pool_.data(), count);
    for (const Rays& rays : inside) {
        if (rays[0].mode.propagates) follow(rays, facet, part, 1);
    }
}

// Maps points to the picture to first order, exact to first order at `length`.
InsideView SplitBeams::view_of(const Rays& rays, double length) const {
    const Vec3 &x0 = rays[0].point, &t0 = rays[0].mode.ray;
    const auto change = [](const Vec3& a, const Vec3& b) { return (b - a) / k_beside; };
    const Vec3 X_u = change(x0, rays[1].point), X_v = change(x0, rays[2].point);
    const Vec3 T_u = change(t0, rays[1].mode.ray), T_v = change(t0, rays[2].mode.ray);
    // Divergence of the rays per length: half the trace of their effect on the sides of an area.
    const double area = glm::dot(t0, glm::cross(X_u, X_v));
    const double k =
        area != 0
            ? 0.5 * (glm::dot(glm::cross(X_v, t0), T_u) + glm::dot(glm::cross(t0, X_u), T_v)) / area
            : 0;
    const Vec3 Y_u = X_u + length * T_u, Y_v = X_v + length * T_v;
    const double determinant = glm::dot(t0, glm::cross(Y_u, Y_v));
    const Vec3 a_u = glm::cross(Y_v, t0) / determinant, a_v = glm::cross(t0, Y_u) / determinant,
               a_s = glm::cross(Y_u, Y_v) / determinant;
    const double scale = 1 + length * k;
    // Affine rows: w, then x w and y w.
    const glm::dvec4 w(k * a_s, 1 - k * glm::dot(a_s, x0));
    const auto row = [&](const Vec3& a, double at) {
        return scale * glm::dvec4(a, -glm::dot(a, x0)) + at * w;
    };
    const glm::dvec4 x = row(a_u, reference_.x), y = row(a_v, reference_.y);
    InsideView view;
    for (int i = 0; i < 4; ++i) {
        view.map.m[static_cast<std::size_t>(i)] = x[i];
        view.map.m[static_cast<std::size_t>(4 + i)] = y[i];
        view.map.m[static_cast<std::size_t>(8 + i)] = w[i];
    }
    view.eye = k * x0 - t0;
    view.eye_weight = k;
    view.parity = determinant > 0 ? 1 : -1;
    return view;
}

void SplitBeams::absorb(Ray& ray, double way) const {
    const std::array<double, 3> shares = absorption_shares(band_.crystal, ray.mode);
    for (std::size_t node = 0; node < static_cast<std::size_t>(band_.count); ++node) {
        double alpha = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            alpha += shares[axis] * band_.absorption[axis][node];
        double& transmitted = ray.transmitted[node];
        transmitted *= std::exp(std::min(-alpha * way, k_most_regained));
        transmitted = std::min(transmitted, std::exp(k_most_regained));
    }
}

// Follows a beam that left `facet`, the `event`th facet that it met.
void SplitBeams::follow(const Rays& rays, int facet, const FacetRegion& part, int event) {
    ++beams_;
    constexpr long long k_asked_after = 1024;
    if (beams_ % k_asked_after == 0 && limits_.goes_on && !limits_.goes_on(beams_)) stopped_ = true;
    if (stopped_) return;
    const double kept = rays[0].weight * mean_transmitted(rays[0]), area = 0.5 * part.doubled_area;
    if (event >= limits_.depth || !(kept >= limits_.cut_weight)) {
        remainder_ += kept * area;
        return;
    }
    const Vec3 &x0 = rays[0].point, &t0 = rays[0].mode.ray;
    const int exit = net_.exit_of(facet, x0, t0);
    const auto length_to = [](const Ray& ray, const Plane& plane) {
        return -height_above(plane, ray.point) / glm::dot(plane.normal, ray.mode.ray);
    };
    const double length = std::max(0.0, length_to(rays[0], net_.plane(exit)));
    const std::size_t pool_before = pool_.size();
    std::vector<FacetRegion> parts;
    splitter_.split(view_of(rays, length), pool_, part.region, facet, exit,
                    middle_of(pool_.data() + part.region.first, part.region.count), parts);
    double followed = 0;
    for (const FacetRegion& next : parts) {
        const Plane& plane = net_.plane(next.facet);
        bool meets = true;
        for (const Ray& ray : rays) meets = meets && glm::dot(plane.normal, ray.mode.ray) > 0;
        // The reference ray sees it edge-on: count it as remainder.
        if (!meets) continue;
        followed += next.doubled_area;
        Rays at = rays;
        std::array<CrystalHit, 3> hits;
        for (int i = 0; i < 3; ++i) {
            Ray& ray = at[i];
            const double way = length_to(ray, plane);
            ray.point += way * ray.mode.ray;
            if (band_.absorbs) absorb(ray, way);
            hits[i] = hit_face(band_.crystal, band_.n_outside, ray.mode, plane.normal);
        }
        absorbed_ += 0.5 * next.doubled_area * rays[0].weight *
                     (mean_transmitted(rays[0]) - mean_transmitted(at[0]));
        if (hits[0].transmitted > 0) leave(hits, at, next, event + 1);
        for (int m = 0; m < 2; ++m) {
            if (!hits[0].modes[m].propagates || !(hits[0].power[m] > 0)) continue;
            Rays inside = at;
            for (int i = 0; i < 3; ++i) {
                // If this ray's wave is evanescent, use the reference ray's.
                const CrystalHit& hit = hits[i].modes[m].propagates ? hits[i] : hits[0];
                inside[i].mode = hit.modes[m];
                inside[i].weight *= hit.power[m];
            }
            follow(inside, next.facet, next, event + 1);
        }
    }
    remainder_ += kept * (area - 0.5 * followed);
    pool_.resize(pool_before);
}

void SplitBeams::leave(const std::array<CrystalHit, 3>& hits, const Rays& at,
                       const FacetRegion& part, int event) {
    LeavingRays rays;
    for (std::size_t i = 0; i < 3; ++i) {
        const CrystalHit& hit = hits[i].transmitted > 0 ? hits[i] : hits[0];
        rays.points[i] = at[i].point;
        rays.directions[i] = hit.exit_direction;
        rays.tangents[i] = hit.s;
        const Complex &s = hit.out[0], &p = hit.out[1];
        rays.weights[i] = at[i].weight * hit.transmitted;
        rays.Q[i] = at[i].weight * (std::norm(s) - std::norm(p));
        rays.U[i] = at[i].weight * 2 * (s * std::conj(p)).real();
    }
    LeavingBeam beam = rays.beam(reference_);
    beam.facets = event;
    for (std::size_t node = 0; node < static_cast<std::size_t>(band_.count); ++node) {
        const std::array<double, 3> change = with_changes(std::array<double, 3>{
            at[0].transmitted[node], at[1].transmitted[node], at[2].transmitted[node]});
        for (std::size_t i = 0; i < 3; ++i) beam.transmitted[i][node] = change[i];
    }
    (*sink_)(beam, pool_.data() + part.region.first, part.region.count);
}

}  // namespace culet
