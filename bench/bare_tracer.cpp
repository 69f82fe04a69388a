#include "bench/bare_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/geometry/convex_body.h"

namespace culet {

namespace {

constexpr int k_longest = 1024;

class BareTracer {
public:
    BareTracer(const Scene& scene, int depth, double cut)
        : body_(scene.stone.solid),
          constant_(scene.lights.constant),
          n_(scene.stone.material.index[0].at(scene.settings.wavelengths_nm.at(0))),
          depth_(std::min(depth, k_longest - 1)),
          cut_(cut) {
        for (const CosinePowerLight& lobe : lights_of_type<CosinePowerLight>(scene.lights)) {
            lobes_.push_back(
                {lobe.direction, lobe.exponent, std::get<double>(lobe.radiance.value)});
        }
        for (const DiscLight& cap : lights_of_type<DiscLight>(scene.lights)) {
            caps_.push_back({cap.direction, cosines_of(cap), std::get<double>(cap.radiance.value)});
        }
    }

    double radiance(const Vec3& eye, Vec3 direction) {
        const auto entry = body_.entry(eye, direction, entry_);
        if (!entry) return light(direction);
        ++rays;
        Vec3 at = body_.on_facet(entry->facet, eye + entry->distance * direction);
        Vec3 n = -body_.normal(entry->facet);
        met_[0] = entry->facet;
        double q1 = std::min(glm::dot(direction, n), 1.0);
        double q2 = std::sqrt((n_ - 1) * (n_ + 1) + q1 * q1);
        const double first = reflected(1, n_ * n_, q1, q2);
        double sum = first * light(mirrored(direction, n)), weight = 1 - first;
        direction = glm::normalize(direction + (q2 - q1) * n);
        for (int event = 2; event <= depth_; ++event) {
            if (weight < cut_) break;
            const std::size_t k = static_cast<std::size_t>(event - 1);
            const BodyHit hit = body_.exit(at, direction, met_[k]);
            met_[k] = hit.facet;
            at = body_.on_facet(hit.facet, at + hit.distance * direction);
            n = body_.normal(hit.facet);
            q1 = n_ * glm::dot(direction, n);
            const double squared = q1 * q1 - (n_ - 1) * (n_ + 1);
            if (squared > 0) {
                q2 = std::sqrt(squared);
                const double R = reflected(n_ * n_, 1, q1, q2);
                sum += weight * (1 - R) * light(glm::normalize(n_ * direction + (q2 - q1) * n));
                weight *= R;
            }
            direction = mirrored(direction, n);
        }
        return sum;
    }

    long long rays = 0;

private:
    static double reflected(double e1, double e2, double q1, double q2) {
        const double s = (q1 - q2) / (q1 + q2), p = (e2 * q1 - e1 * q2) / (e2 * q1 + e1 * q2);
        return 0.5 * (s * s + p * p);
    }
    static Vec3 mirrored(const Vec3& direction, const Vec3& n) {
        const Vec3 v = direction - 2 * glm::dot(direction, n) * n;
        return (1.5 - 0.5 * glm::dot(v, v)) * v;
    }
    double light(const Vec3& direction) const {
        double sum = constant_;
        for (const Lobe& lobe : lobes_) {
            const double cosine = glm::dot(direction, lobe.direction);
            if (cosine > 0) sum += lobe.radiance * std::pow(cosine, lobe.exponent);
        }
        for (const Cap& cap : caps_) {
            const double cosine = glm::dot(direction, cap.direction);
            if (cosine <= cap.cosines.from && cosine > cap.cosines.to) sum += cap.radiance;
        }
        return sum;
    }

    ConvexBody body_;
    struct Lobe {
        Vec3 direction;
        double exponent, radiance;
    };
    struct Cap {
        Vec3 direction;
        DiscCosines cosines;
        double radiance;
    };
    double constant_;
    std::vector<Lobe> lobes_;
    std::vector<Cap> caps_;
    double n_;
    int depth_;
    double cut_;
    EntryGuess entry_;
    std::array<int, k_longest> met_{};
};

}  // namespace

BarePicture draw_bare(const Scene& scene, int side, int depth, double cut) {
    constexpr int k_tile = 16;
    const Camera& camera = scene.camera;
    BareTracer tracer(scene, depth, cut);
    BarePicture picture;
    const int width = camera.width, height = camera.height;
    picture.radiance.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const Vec3 forward = glm::normalize(camera.look_at - camera.position),
               right = glm::normalize(glm::cross(forward, camera.up)),
               down = glm::cross(forward, right);
    const double pixel = 2 * std::tan(camera.fov / 2) / height, share = 1.0 / (side * side);
    // Tile by tile in alternating directions, like the reference.
    for (int y0 = 0; y0 < height; y0 += k_tile) {
        for (int x0 = 0; x0 < width; x0 += k_tile) {
            const int x1 = std::min(x0 + k_tile, width);
            for (int y = y0; y < std::min(y0 + k_tile, height); ++y) {
                for (int column = 0; column < x1 - x0; ++column) {
                    const int x = (y - y0) % 2 == 0 ? x0 + column : x1 - 1 - column;
                    double sum = 0;
                    for (int i = 0; i < side * side; ++i) {
                        const double px = x + (i % side + 0.5) / side,
                                     py = y + (i / side + 0.5) / side;
                        const Vec3 across =
                            (px - 0.5 * width) * pixel * right + (py - 0.5 * height) * pixel * down;
                        sum += tracer.radiance(camera.position, glm::normalize(forward + across));
                    }
                    picture.radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(x)] = share * sum;
                }
            }
        }
    }
    picture.rays = tracer.rays;
    return picture;
}

}  // namespace culet
